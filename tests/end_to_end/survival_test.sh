#!/usr/bin/env bash
# Whatever a method does, and whenever the program is killed: results are complete or not there.
# Usage: survival_test.sh RELOCK MISBEHAVING [KILLS]      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1 misbehaving=$2 kills=${3:-12}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

same_results() {  # A B: all files but the timing are the same, byte for byte, and nothing is left over
  diff --recursive --exclude timing.csv "$1" "$2" >/dev/null && echo same || echo different
}

cat >"$work/plan.toml" <<PLAN
sequences = ["klahaag", "klahaag-prints"]
methods = ["kcf", "aruco"]
gaps = ["bernoulli(0.2)"]
protocols = ["once", "reset"]
seeds = [1, 2]
PLAN
plan() { "$relock" run "$work/plan.toml" "$@"; }

# The same bytes for any number of jobs.
plan --out "$work/one" --jobs 1 >"$work/one.txt" 2>&1
expect "a plan runs" 0 $?
plan --out "$work/three" --jobs 3 >"$work/three.txt" 2>&1
expect "jobs do not matter" same "$(same_results "$work/one" "$work/three")"
expect "not to what is printed either" "$(sed 's/ in [0-9.]* s$//; s/[a-z]*$//' "$work/one.txt" | grep -vc Results)" \
  "$(sed 's/ in [0-9.]* s$//; s/[a-z]*$//' "$work/three.txt" | grep -vc Results)"
expect_contains "what makes no sense is left out, and said so" "left out: aruco reads codes of" "$(cat "$work/one.txt")"
runs=$(find "$work/one" -name run.json | wc -l)
expect "a second call runs nothing" "$runs" "$(plan --out "$work/one" | grep -c 'kept: the same run is there already')"

# Killed at random moments, a number of times; then finished.
RANDOM=7
killed=0
for ((i = 0; i < kills; ++i)); do
  "$relock" run "$work/plan.toml" --out "$work/killed" --jobs 2 >/dev/null 2>&1 &  # a function would be another process
  victim=$!
  sleep "0.$(printf '%03d' $((RANDOM % 600)))"
  kill -9 "$victim" 2>/dev/null && wait "$victim" 2>/dev/null
  [[ $? == 137 ]] && ((++killed))
  while read -r run; do  # what is there is what it will be
    there=${run%/run.json}
    cmp -s "$there/trajectory.csv" "$work/one/${there#"$work/killed/"}/trajectory.csv" || echo "$there" >>"$work/torn"
  done < <(find "$work/killed" -name run.json -not -path '*/.*' 2>/dev/null)
done
expect "most were killed at work" yes "$( ((killed > kills / 2)) && echo yes || echo "no, $killed of $kills")"
expect "nothing torn" "" "$(cat "$work/torn" 2>/dev/null)"
plan --out "$work/killed" --jobs 2 >/dev/null 2>&1
expect "killed $kills times and finished: the same as undisturbed" same "$(same_results "$work/one" "$work/killed")"

# Interrupted, as by Ctrl-C.
"$relock" run "$work/plan.toml" --out "$work/stopped" >"$work/stopped.txt" 2>&1 &
victim=$!
for _ in $(seq 100); do [[ -n $(find "$work/stopped" -name run.json -not -path '*/.*' 2>/dev/null) ]] && break; sleep 0.05; done
kill -INT "$victim"
wait "$victim"
expect "an interrupt: exit status" 130 $?
expect_contains "an interrupt is told" "of $runs runs are complete and kept, and the same command goes on" "$(cat "$work/stopped.txt")"
expect "and leaves no drafts" "" "$(find "$work/stopped" -name '.*.tmp.*')"
plan --out "$work/stopped" >/dev/null 2>&1
expect "and is gone on from" same "$(same_results "$work/one" "$work/stopped")"

# Two programs, one folder.
"$misbehaving" run --methods 'hang(at=3)' --frame-limit 20 --out "$work/busy" >/dev/null 2>&1 &
busy=$!
sleep 0.5
expect_contains "two programs in one folder" "another relock is writing into" "$("$relock" run --methods still --out "$work/busy" 2>&1)"
kill -9 $busy
wait $busy 2>/dev/null

# Methods that misbehave are named, scored as failed, and disturb nobody.
"$misbehaving" run --methods crash,leave,hang,eat,throw-odd,kcf --frame-limit 3 --memory-limit 200 --jobs 2 \
  --out "$work/bad" >"$work/bad.txt" 2>"$work/bad.err"
expect "a failed method: exit status" 1 $?
errors=$(cat "$work/bad.err")
expect_contains "a crash" 'crash failed on frame 20: was killed by signal 11 (SIGSEGV); it last wrote "about to fall over "' "$errors"
expect_contains "leaving" "leave failed on frame 20: left the program with status 0" "$errors"
expect_contains "a hang" "hang failed on frame 20: gave no answer for 3 s" "$errors"
expect_contains "out of memory" "eat failed on frame 20: ran out of memory" "$errors"
expect_contains "an exception that is none" "throw-odd failed on frame 20: threw something that is no exception" "$errors"
expect "one sentence each" 5 "$(wc -l <"$work/bad.err")"
expect_contains "the record names the failure" '"what": "was killed by signal 11 (SIGSEGV)"' "$(cat "$work/bad/klahaag/recorded-once/crash/run.json")"
expect_contains "and what was written last" 'about to fall over' "$(cat "$work/bad/klahaag/recorded-once/crash/run.json")"
expect "what was said before is kept" 19 "$(grep -c sighting "$work/bad/klahaag/recorded-once/crash/trajectory.csv")"
expect_contains "it is scored" "crash failed on frame 20" "$("$relock" score "$work/bad")"
"$relock" run --methods kcf --out "$work/good" >/dev/null
expect "the others say what they say alone" "$(cksum <"$work/good/klahaag/recorded-once/kcf/trajectory.csv")" "$(cksum <"$work/bad/klahaag/recorded-once/kcf/trajectory.csv")"

# Dry runs and mistakes in a plan.
expect_contains "a dry run estimates" "of them there already; the others take about" "$(plan --out "$work/dry" --dry-run)"
expect "and writes nothing" "" "$(ls "$work/dry" 2>/dev/null)"
mistake() {  # WHAT SENTENCE TEXT
  printf '%s\n' "$3" >"$work/wrong.toml"
  expect_contains "$1" "$2" "$("$relock" run "$work/wrong.toml" 2>&1)"
}
mistake "no TOML" "wrong.toml:1:" 'methods = ['
mistake "an unknown key" 'wrong.toml:2:1: no key is called "method" (did you mean "methods"?)' $'sequences = ["klahaag"]\nmethod = ["kcf"]'
mistake "a method mistyped" 'wrong.toml:2:12: methods, character' $'sequences = ["klahaag"]\nmethods = ["kcf(a=1"]'
mistake "no protocol" 'wrong.toml:3:14: no protocol is called "twice"' $'sequences = ["klahaag"]\nmethods = ["kcf"]\nprotocols = ["twice"]'
mistake "no methods" "wrong.toml: a plan needs methods" 'sequences = ["klahaag"]'
mistake "a seed that is none" "wrong.toml:3:10: a seed is a whole number from 0" $'sequences = ["klahaag"]\nmethods = ["kcf"]\nseeds = [-1]'
expect_contains "a plan and more" "a plan says what to run" "$(plan --methods kcf 2>&1)"
expect_contains "no plan that exists" "cannot be read" "$("$relock" run "$work/none.toml" 2>&1)"
finish
