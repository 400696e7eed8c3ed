#!/usr/bin/env bash
# The jump curve: what cannot lose is never lost, what stays where it was is, and the curve is the same however it is made.
# Usage: jump_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

jump() { "$relock" jump "$@" --seeds 2 --out "$work/jump"; }
one=$(jump oracle,still,kcf --jobs 2)
expect "a curve is made" 0 $?
expect "and is the same when made again" "$one" "$(jump oracle,still,kcf --jobs 1)"
expect_contains "bins of displacement" "0.25 to 0.5" "$one"
figures=$(jump oracle,still,mute --json)
lost() {  # METHOD: all jumps lost, and tried
  python3 -c 'import json, sys
for method in json.load(sys.stdin)["methods"]:
  if method["method"] == sys.argv[1]: print(sum(b["lost"] for b in method["bins"]), sum(b["tried"] for b in method["bins"]))' "$1" <<<"$figures"
}
read -r oracle_lost oracle_tried <<<"$(lost oracle)"
expect "the truth is never lost" 0 "$oracle_lost"
expect "over many jumps" yes "$([[ $oracle_tried -ge 20 ]] && echo yes)"
read -r still_lost still_tried <<<"$(lost still)"
expect "who does not move loses what does" yes "$([[ $still_lost -gt 0 && $still_tried -gt $still_lost ]] && echo yes)"
expect "who never answers holds nothing that could be lost" "0 0" "$(lost mute)"
expect_contains "without a gap in time" "without a gap in time" "$(jump still --no-time-gap)"
if command -v gnuplot >/dev/null; then
  jump oracle --plot "$work/curve.svg" >/dev/null
  expect "the curve is drawn" yes "$([[ -s $work/curve.svg ]] && echo yes)"
fi

expect_mistake jump "an unknown method" 'did you mean "kcf"?' kfc --out "$work/jump" --seeds 2
expect_mistake jump "codes of another kind" "reads codes of another kind" aruco --out "$work/jump" --seeds 2
expect_mistake jump "other flights" "was flown by another plan" kcf --out "$work/jump" --seeds 2 --exposure 3
expect_mistake jump "a recording and a flight" "--sequence is given" kcf --sequence klahaag --exposure 3
finish
