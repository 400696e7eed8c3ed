#!/usr/bin/env bash
# Videos of runs: at the recording's own times, frozen in gaps, whole or not there.
# Usage: films_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$relock" run --sequence recordings/klahaag --methods kcf,template --gaps 'bernoulli(0.3)' --out "$work/runs" >/dev/null
said=$("$relock" video "$work/runs" -o "$work/film.mp4" 2>&1)
if [[ $said == *libx264* ]]; then
  echo "films_test.sh: left out, as this libavcodec has no libx264"
  exit 77
fi
expect_contains "a video is made" "film.mp4: 53 pictures of" "$said"

# The times are the recording's, to the microsecond that an MP4 keeps.
if command -v ffprobe >/dev/null; then
  shown=$(ffprobe -v error -select_streams v -show_entries packet=pts_time -of csv=p=0 "$work/film.mp4" | tr -d ',')
  expect "as many pictures as frames" 53 "$(wc -l <<<"$shown")"
  truth=$(tail -n +2 "$work/runs/klahaag/recording/timestamps.csv")
  expect "each at its frame's time, to a microsecond" 0 \
    "$(paste <(echo "$truth") <(echo "$shown") | awk 'NR == 1 { first = $1 } { d = ($1 - first) / 1e9 - $2; if (d < -2e-6 || d > 2e-6) ++wrong } END { print wrong + 0 }')"
  expect "H.264" h264 "$(ffprobe -v error -select_streams v -show_entries stream=codec_name -of csv=p=0 "$work/film.mp4" | tr -d ',')"
  duration=$(ffprobe -v error -show_entries format=duration -of csv=p=0 "$work/film.mp4")
  expect "and as long, to a frame" yes "$(awk -v d="$duration" 'BEGIN { print (d > 1.72 && d < 1.80) ? "yes" : "no, " d }')"
fi
expect_contains "relock reads it back" "53 frames" "$("$relock" inspect "$work/film.mp4" --no-pictures)"

# Some of it, of some.
expect_contains "a part, of one method" "part.mp4: 16 pictures of" \
  "$("$relock" video "$work/runs" -o "$work/part.mp4" --method kcf --from 0.5 --to 1.01 2>&1)"

# A recording with gaps of its own: the picture stands, and is shown at every slot.
"$relock" run --sequence recordings/klahaag --methods kcf --out "$work/whole" >/dev/null
expect_contains "without gaps nothing stands" "whole.mp4: 53 pictures of" "$("$relock" video "$work/whole" -o "$work/whole.mp4")"

# Mistakes, interrupts, a full disk.
expect_mistake video "there already" "is there already" "$work/runs" -o "$work/film.mp4"
expect_mistake video "another ending" "it ends in .mp4" "$work/runs" -o "$work/film.avi"
expect_mistake video "another recording" "is not what" "$work/runs" -o "$work/d.mp4" --sequence recordings/klahaag-prints
expect_mistake video "no such method" "there is no run of kfc" "$work/runs" -o "$work/d.mp4" --method kfc
expect_mistake video "no such part" "has no frame from 7 s to 8 s" "$work/runs" -o "$work/d.mp4" --from 7 --to 8
full=$( (ulimit -f 8; trap '' XFSZ; "$relock" video "$work/runs" -o "$work/d.mp4" 2>&1) )
expect "a full disk: exit status" 2 $?
expect_contains "a full disk" "is the disk full" "$full"
"$relock" video "$work/runs" -o "$work/d.mp4" >"$work/said" 2>&1 &
victim=$!
for _ in $(seq 200); do [[ -n $(find "$work" -name '.d.mp4.tmp.*') ]] && break; sleep 0.02; done
kill -INT "$victim"
wait "$victim"
expect "an interrupt: exit status" 130 $?
expect_contains "an interrupt" "interrupted; no video was written" "$(cat "$work/said")"
expect "none of them leaves anything" "" "$(find "$work" -maxdepth 1 -name '*d.mp4*')"
finish
