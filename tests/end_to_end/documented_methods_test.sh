#!/usr/bin/env bash
# The detector and the tracker of docs/adding-a-*.md, compiled as they stand there, at work.
# Usage: documented_methods_test.sh RELOCK DETECTOR_PROGRAM TRACKER_PROGRAM      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
detector=$2 tracker=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for page in docs/adding-a-detector.md docs/adding-a-tracker.md; do
  lines=$(awk '/^```cpp/ { inside = 1; next } /^```/ { inside = 0 } inside' $page | wc -l)
  expect "$page shows one file of at most 60 lines" yes "$(((lines > 0 && lines <= 60)) && echo yes)"
done
expect_contains "the detector is listed" "brightest" "$("$detector" list)"
expect_contains "and detects" "something at" "$("$detector" detect recordings/klahaag/images/00001.jpg --method brightest)"
expect_contains "the tracker is listed" "mine" "$("$tracker" list)"
expect_contains "the detector keeps its promises" "17 passed, 0 failed" "$("$detector" check brightest --budget 3)"
expect_contains "so does the tracker" "18 passed, 0 failed" "$("$tracker" check mine --budget 3)"
"$tracker" run --sequence recordings/klahaag --methods mine,kcf --out "$work/results" >/dev/null
expect "and runs" 0 $?
expect_contains "beside the others" "mine" "$("$tracker" timeline "$work/results")"
finish
