#!/usr/bin/env bash
# What changed between two result folders, and whether a job is to fail for it.
# Usage: compare_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for seed in 1 2; do
  "$relock" run --sequence recordings/klahaag --methods kcf,template --gaps 'bernoulli(0.2)' --seed $seed --out "$work/before" >/dev/null
done
cp -r "$work/before" "$work/after"
# The method after a change: it says nothing from frame 30 on, under the first seed.
changed=$work/after/klahaag/bernoulli-0.2-s1-once/kcf/trajectory.csv
awk -F, 'NR > 1 && $1 >= 30 && $3 != "dropped" { printf "%s,%s,nothing", $1, $2; for (i = 4; i <= NF; ++i) printf ","; print ""; next } { print }' \
  "$work/before/klahaag/bernoulli-0.2-s1-once/kcf/trajectory.csv" >"$changed"

compare() { "$relock" compare "$@" 2>&1; }

same=$(compare "$work/before" "$work/before" --fail-if 'losses rises > 0')
expect "nothing changed: exit status" 0 $?
expect_contains "nothing changed" "the same answers in A and B: kcf, template" "$same"
expect_contains "and passes" "passes 'losses rises > 0'" "$same"

said=$(compare "$work/before" "$work/after")
expect "without a condition: exit status" 0 $?
expect_contains "who says the same" "the same answers in A and B: template" "$said"
expect_contains "a new loss" "losses of kcf: 1 new" "$said"
expect_contains "with where and how" "new   klahaag, seed 1: lost, and said so, at" "$said"

fails=$(compare "$work/before" "$work/after" --fail-if 'availability drops > 0.02' --fail-if 'template: losses rises > 0')
expect "a condition that holds: exit status" 1 $?
expect_contains "says which" "fails 'availability drops > 0.02': kcf, gaps bernoulli(0.2), protocol once: availability drops by 0." "$fails"
expect_contains "and which do not" "passes 'template: losses rises > 0'" "$fails"
compare "$work/before" "$work/after" --fail-if 'availability drops > 0.9' >/dev/null
expect "one that does not hold: exit status" 0 $?
compare "$work/after" "$work/before" --fail-if 'availability drops > 0' >/dev/null
expect "better is no worse: exit status" 0 $?
expect_contains "a loss is gone, the other way round" "losses of kcf: 1 gone" "$(compare "$work/after" "$work/before")"

"$relock" compare "$work/before" "$work/after" --json --fail-if 'losses rises > 0' >"$work/json"
expect "as JSON: exit status" 1 $?
if command -v python3 >/dev/null; then
  expect "JSON tells the same" "1 0 True" "$(python3 -c '
import json, sys
told = json.load(open(sys.argv[1]))
kcf, template = told["groups"][0]["methods"]
print(kcf["loss_counts"]["new"], template["loss_counts"]["new"], told["fail_if"][0]["holds"])' "$work/json")"
fi

# Mistakes.
"$relock" run --sequence recordings/klahaag --methods mosse --out "$work/other" >/dev/null
nothing=$(compare "$work/before" "$work/other")
expect "nothing in common: exit status" 2 $?
expect_contains "nothing in common" "A and B have no run in common" "$nothing"
expect_contains "says what there is" "only in B: method mosse (1 run)" "$nothing"
expect_contains "only in one is said" "only in B: method mosse (1 run)" "$(cp -r "$work/before" "$work/more" && cp -r "$work/other/klahaag/recorded-once" "$work/more/klahaag/" && compare "$work/before" "$work/more")"
wrong=$(compare "$work/before" "$work/after" --fail-if 'availability falls > 0.02')
expect "a mistake in a condition: exit status" 2 $?
expect_contains "points at the character" "--fail-if, character 14: \"drops\" or \"rises\" belongs here" "$wrong"
expect_contains "no such method" "did you mean \"kcf\"?" "$(compare "$work/before" "$work/after" --fail-if 'kfc: losses rises > 0')"
expect_contains "no such method to pair" "--pair: B has no method csrt" "$(compare "$work/before" "$work/after" --pair kcf=csrt)"
expect_mistake compare "a folder without results" "no runs" "$work/before" recordings/klahaag
finish
