#!/usr/bin/env bash
# The paired gap experiment and the story of each loss, on the real clip.
# Usage: gaps_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
root=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$relock" run --sequence recordings/klahaag --methods kcf --gaps 'gilbert-elliott(0.1,0.3)' --seed 2 --paired \
  --out "$work/a" >"$work/said"
expect "a paired run ends well" 0 $?
expect_contains "and tells the cost" "Cost of the gaps gilbert-elliott(0.1,0.3): klahaag, seed 2" "$(cat "$work/said")"
expect "both arms are there" "gilbert-elliott-0.1-0.3-s2-once recorded-s2-once recording" \
  "$(cd "$work/a/klahaag" && echo *)"
"$relock" cost "$work/a" >"$work/cost"
expect "cost prints the same again" "$(sed -n '/^Cost/,$p' "$work/said")" "$(cat "$work/cost")"
expect "as JSON it has every method" 5 "$("$relock" cost "$work/a" --json | grep -c '"method"')"

cat >"$work/plan.toml" <<EOF
sequences = ["$root/recordings/klahaag"]
methods = ["template"]
gaps = ["paper", "fps(10)"]
seeds = [1, 2]
paired = true
EOF
"$relock" run "$work/plan.toml" --out "$work/b" >"$work/said"
expect "a plan is paired, too" 0 $?
expect "each pattern has its table, over both seeds" 2 "$(grep -c '^Cost of the gaps .*: klahaag, seeds 1, 2,' "$work/said")"

sed -i '/^gaps/d' "$work/plan.toml"
"$relock" run "$work/plan.toml" --out "$work/c" >/dev/null 2>"$work/said"
expect "a paired plan without gaps is refused" 2 $?
expect_contains "with file and line" "plan.toml:4:" "$(cat "$work/said")"
"$relock" run --methods kcf --paired --out "$work/c" >/dev/null 2>"$work/said"
expect "and so on the command line" 2 $?
"$relock" run --sequence recordings/klahaag --methods kcf --gaps paper --out "$work/d" >/dev/null
"$relock" cost "$work/d" >/dev/null 2>"$work/said"
expect "one arm has no cost" 2 $?
expect_contains "and what to do is said" "--paired" "$(cat "$work/said")"

lost=$work/a/klahaag/gilbert-elliott-0.1-0.3-s2-once/kcf
"$relock" explain "$lost" >"$work/explained"
expect "explain ends well" 0 $?
expect_contains "it tells the gap and whose it was" "over a gap of 8 slots (7 injected)" "$(cat "$work/explained")"
"$relock" score "$lost" >/dev/null
expect "it tells as many losses as events.csv has" "$(grep -c '^loss' "$lost/events.csv")" \
  "$("$relock" explain "$lost" --json | grep -c '"onset_s"')"
expect "of many runs yardsticks are left out" 0 "$("$relock" explain "$work/a" | grep -c ' mute, target')"
expect_contains "and told when they are asked for" "mute, target shirt: 1 loss" \
  "$("$relock" explain "$work/a/klahaag/recorded-s2-once/mute")"
"$relock" explain "$work/a" --target skirt >/dev/null 2>"$work/said"
expect "a target that is not there is refused" 2 $?
expect_contains "and the one that was meant is named" 'did you mean "shirt"' "$(cat "$work/said")"

for method in kcf medianflow; do
  "$relock" run --sequence recordings/klahaag --methods $method --gaps paper --paired --out "$work/two/$method" >/dev/null
done
expect "arms in two folders: every method has its cost" "kcf medianflow" \
  "$("$relock" cost "$work/two" | grep -xE '  (kcf|medianflow) *' | xargs)"
"$relock" run --sequence recordings/klahaag --methods still --gaps paper --paired --real-time latest \
  --latency 'constant(70ms)' --out "$work/slow" >"$work/said"
expect_contains "in real time frames come that are not looked at" "recorded frames were looked at in both arms" "$(cat "$work/said")"
"$relock" explain "$work/slow" --json >"$work/said"
expect_contains "explain says so, too" '"real_time": "latest"' "$(cat "$work/said")"
expect_contains "and the latency" '"latency": "constant(70ms)"' "$(cat "$work/said")"

sed -i '9s/^[0-9]*,/77,/' "$work/a/klahaag/recorded-s2-once/kcf/trajectory.csv"
"$relock" cost "$work/a" >"$work/cost" 2>"$work/said"
expect "a run that cannot be read: exit status" 2 $?
expect_contains "it is left out" "trajectory.csv:9: frame 77 comes after frame 6" "$(cat "$work/said")"
expect "and the cost is told of the others" 0 "$(grep -v 'left out' "$work/cost" | grep -c -w kcf)"
expect_contains "its other arm is named" "there is no run of kcf as recorded" "$(cat "$work/cost")"
expect_contains "yardsticks are still told of" "yardsticks without any difference: " "$(cat "$work/cost")"

finish
