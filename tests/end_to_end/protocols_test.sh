#!/usr/bin/env bash
# Protocols vot and multistart, and real time, on the real clip.
# Usage: protocols_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { "$relock" run --sequence recordings/klahaag "$@" >"$work/said" 2>&1; }
bytes_of() { (cd "$1" && find . -type f ! -name timing.csv -print0 | sort -z | xargs -0 sha256sum); }
verdicts() { awk -F, 'NR > 1 && $3 == "'"$2"'"' "$1/verdicts.csv" | wc -l; }

# Every anchor and direction is a run of its own, the same whatever the number of jobs.
run --methods linear --protocol multistart --gaps 'bernoulli(0.2)' --out "$work/starts"
expect "multistart ends well" 0 $?
run --methods linear --protocol multistart --gaps 'bernoulli(0.2)' --out "$work/starts2" --jobs 3
for results in starts starts2; do "$relock" score "$work/$results" >"$work/$results.scores"; done
expect "any number of jobs gives the same bytes" "$(bytes_of "$work/starts")" "$(bytes_of "$work/starts2")"
run --methods linear --protocol multistart --gaps 'bernoulli(0.2)' --out "$work/starts"
expect "runs that are there are kept" 8 "$(grep -c 'kept: the same run is there already' "$work/said")"
forward=$work/starts/klahaag/bernoulli-0.2-s1-multistart-0000-forward
backward=$work/starts/klahaag/bernoulli-0.2-s1-multistart-0050-backward
expect "backward is begun at the anchor" 2 "$(awk -F, '$3 == "given" { print $1 }' "$backward/oracle/trajectory.csv")"
expect "and the oracle hits every picture that it is shown" 0 "$(($(verdicts "$backward/oracle" Miss) + $(verdicts "$backward/oracle" Stray)))"
expect "what is before the anchor is not started" 2 "$(verdicts "$backward/oracle" NotStarted)"
for run in "$forward" "$backward"; do
  expect "$(basename "$run"): verdicts add up to the frames" 53 "$(($(wc -l <"$run/linear/verdicts.csv") - 1))"
done
dropped() { awk -F, '$3 == "dropped" { print '"$2"' }' "$1/linear/trajectory.csv" | sort -n; }
expect "both ways lose the same pictures" "$(dropped "$forward" '$1')" "$(dropped "$backward" '52 - $1')"

# VOT.
run --methods mosse --protocol vot --out "$work/vot"
expect "vot ends well" 0 $?
"$relock" score "$work/vot" >/dev/null
vot=$work/vot/klahaag/recorded-vot
expect "mute is started every six frames" 9 "$(grep -c ',given,' "$vot/mute/trajectory.csv")"
expect "frames that are withheld are not started" "$(grep -c ',withheld,' "$vot/mosse/trajectory.csv")" "$(verdicts "$vot/mosse" NotStarted)"
expect "the oracle is started once" 1 "$(grep -c ',given,' "$vot/oracle/trajectory.csv")"
"$relock" survival "$work/vot" >"$work/said"
expect_contains "survival leaves vot out and says why" "left out: protocol vot: its failures are no losses" "$(cat "$work/said")"
expect "and tells no median of it" 0 "$(grep -c -e median -e paper "$work/said")"
"$relock" survival "$work/vot" --json >"$work/said"
expect "nor any in JSON" 0 "$(grep -c '"median"' "$work/said")"

# Real time.
run --methods kcf --real-time latest --latency 'constant(70ms)' --out "$work/slow"
expect "real time ends well" 0 $?
run --methods kcf --real-time latest --latency 'constant(70ms)' --out "$work/slow2" --jobs 3
for results in slow slow2; do "$relock" score "$work/$results" >"$work/$results.scores"; done
expect "a constant latency gives the same bytes" "$(bytes_of "$work/slow")" "$(bytes_of "$work/slow2")"
expect "and the same table" "$(cat "$work/slow.scores")" "$(cat "$work/slow2.scores")"
slow=$work/slow/klahaag/recorded-once-latest-constant-70ms
expect "skipped frames have a verdict" "$(grep -c ',skipped,' "$slow/kcf/trajectory.csv")" "$(verdicts "$slow/kcf" Skipped)"
expect "and all others an answer" 53 "$(($(wc -l <"$slow/kcf/answers.csv") - 1 + $(verdicts "$slow/kcf" Skipped)))"
awk '/^ +method +own frames/ { on = 1 } /own frames: / { on = 0 } on && NF == 9 && $2 ~ /^[01]\./ { print $4 + $5 + $6 + $7 }' \
  "$work/slow.scores" >"$work/sums"
expect "what is lost and what is recognised add up" 5 "$(awk '$1 > 0.9985 && $1 < 1.0015' "$work/sums" | wc -l)"

run --methods kcf --real-time latest --latency 'constant(0ms)' --out "$work/fast"
run --methods kcf --out "$work/patient"
expect "without latency nothing is missed" \
  "$(cat "$work/patient/klahaag/recorded-once/kcf/trajectory.csv")" \
  "$(cat "$work/fast/klahaag/recorded-once-latest-constant-0ms/kcf/trajectory.csv")"
run --methods kcf --real-time latest --latency "$work/patient/klahaag/recorded-once/kcf/timing.csv" --out "$work/filed"
expect "timing.csv of another run serves as latencies" 0 $?
run --methods kcf --real-time 'queue(2)' --out "$work/measured"
expect "measured runs are marked" 1 "$(grep -c '"deterministic": false' "$work/measured/klahaag/recorded-once-queue-2-measured/kcf/run.json")"
expect "others are not" 0 "$(grep -c '"deterministic": false' "$slow/kcf/run.json")"
once=$("$relock" score "$work/measured")
expect "but scored the same every time" "$once" "$("$relock" score "$work/measured")"

cat >"$work/plan.toml" <<END
sequences = ["klahaag"]
methods = ["kcf"]
real_time = "latest"
latency = "constant(70ms)"
out = "$work/planned"
END
"$relock" run "$work/plan.toml" >"$work/said" 2>&1
expect "a plan has real time, too" "$(cat "$slow/kcf/trajectory.csv")" "$(cat "$work/planned/klahaag/recorded-once-latest-constant-70ms/kcf/trajectory.csv")"

refused() {  # WHAT PART ARGUMENT...
  local what=$1 part=$2
  shift 2
  run --out "$work/refused" "$@"
  expect "$what: exit status" 2 $?
  expect_contains "$what" "$part" "$(cat "$work/said")"
}
refused "real time backward" "protocol multistart has no real time" --methods kcf --protocol multistart --real-time latest
refused "real time by VOT" "protocol vot has no real time" --methods kcf --protocol vot --real-time latest
refused "a detector by VOT" "takes no box, and protocol vot" --methods aruco --protocol vot
refused "a latency without real time" "--latency needs --real-time" --methods kcf --latency 'constant(1ms)'
refused "a latency without a unit" 'the latency "constant(20)" is none' --methods kcf --real-time latest --latency 'constant(20)'
refused "a queue without places" 'real time "queue(0)" is none' --methods kcf --real-time 'queue(0)'
printf 'frame,wall_ms\n1,5\n1,6\n' >"$work/latency.csv"
refused "latencies out of order" "latency.csv:3: frame 1 comes after frame 1" --methods kcf --real-time latest --latency "$work/latency.csv"
sed -i '3s/,[0-9]*$/,1/' "$slow/kcf/answers.csv"
expect_contains "an answer that is there before its frame" "answers.csv:3: the answer to frame 2 is there too early" "$("$relock" score "$work/slow" 2>&1)"
finish
