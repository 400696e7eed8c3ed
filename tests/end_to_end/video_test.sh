#!/usr/bin/env bash
# A film of the real clip with a gap in it, run and scored: its frames, its period and its gap are the film's own.
# Usage: video_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! command -v ffmpeg >/dev/null; then
  echo "video_test.sh: skipped: the program ffmpeg is missing; install package ffmpeg"
  exit 77
fi

# The clip's 53 pictures at 30 Hz without frames 20 to 28: a gap of ten periods; frames are then counted anew.
ffmpeg -nostdin -v error -framerate 30 -i recordings/klahaag/images/%05d.jpg \
  -vf "select='not(between(n,20,28))'" -fps_mode passthrough -c:v libx264 -bf 2 "$work/flight.mp4"
awk -F, -v OFS=, 'NR == 1 { print; next } $1 < 20 { print } $1 > 28 { $1 -= 9; print }' \
  recordings/klahaag/labels.csv >"$work/flight.labels.csv"

"$relock" run --sequence "$work/flight.mp4" --methods still --out "$work/out" >"$work/said" 2>&1
expect "a run of a video ends well" 0 $?
expect_contains "with frames, size, length and T" "flight: 44 frames of 640x360, 1.73 s, T 33.333 ms" "$(cat "$work/said")"
interval=$(awk -F, 'NR == 22 { late = $1 } NR == 21 { early = $1 } END { print late - early }' "$(find "$work/out" -name timestamps.csv | head -n 1)")
expect "the gap is as long as it was" 333333 "$((interval / 1000))"
"$relock" score "$work/out" >"$work/scores"
expect "it can be scored" 0 $?
expect "every frame has its verdict" 44 "$(($(cat "$work"/out/*/*/still/verdicts.csv | wc -l) - 1))"

head --bytes=9000 "$work/flight.mp4" >"$work/short.mp4"
expect_contains "a cut film is told" "short.mp4 is no video that can be read, or its beginning or index is missing" \
  "$("$relock" run --sequence "$work/short.mp4" --methods still --out "$work/none" 2>&1)"
expect "and libav says nothing besides" 1 "$("$relock" run --sequence "$work/short.mp4" --methods still --out "$work/none" 2>&1 | wc -l)"
finish
