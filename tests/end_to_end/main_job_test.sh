#!/usr/bin/env bash
# The main job on the real clip: run, score, timeline, detect, list.
# Usage: main_job_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { "$relock" run "$@" >"$work/said" 2>&1; }
bytes_of() { (cd "$1" && find . -type f ! -name timing.csv -print0 | sort -z | xargs -0 sha256sum); }

lossy='trace(recordings/gap_traces/tagslam_test_14_top_left.csv)'
run --sequence recordings/klahaag-prints --methods kcf,aruco,apriltag --gaps "$lossy" --out "$work/a"
expect "a run ends well" 0 $?
run --sequence recordings/klahaag-prints --methods kcf,aruco,apriltag --gaps "$lossy" --out "$work/b"
"$relock" score "$work/a" >"$work/scores"
expect "a score ends well" 0 $?
"$relock" score "$work/b" >"$work/scores.b"
expect "two runs give the same bytes" "$(bytes_of "$work/a")" "$(bytes_of "$work/b")"
expect "and the same table" "$(cat "$work/scores")" "$(cat "$work/scores.b")"

run --sequence recordings/klahaag-prints --methods kcf,aruco,apriltag --gaps "$lossy" --out "$work/a"
expect "a run that is there is not run again" 7 "$(grep -c 'kept: the same run is there already' "$work/said")"

once="$work/a/klahaag-prints/trace-tagslam_test_14_top_left-s1-once"
for method in mute still linear oracle; do
  expect "every comparison carries $method" yes "$([[ -e $once/$method/run.json ]] && echo yes)"
done
pooled() { awk -F, 'NR > 1 && $3 == "'"$2"'"' "$once/$1/verdicts.csv" | wc -l; }
expect "oracle hits every delivered frame" 0 "$(($(pooled oracle Miss) + $(pooled oracle Stray)))"
expect "mute never hits" 0 "$(pooled mute Hit)"
expect "verdicts are as many as frames and targets" $((53 * 3)) "$(($(wc -l <"$once/kcf/verdicts.csv") - 1))"
expect "aruco is not asked about the shirt" 53 "$(grep -c ',shirt,NotStarted,' "$once/aruco/verdicts.csv")"
expect "dropped frames have a row" "$(grep -c ',dropped,' "$once/kcf/trajectory.csv")" "$(grep -c ',shirt,Dropped,' "$once/kcf/verdicts.csv")"

"$relock" timeline "$work/a" >"$work/timeline"
expect_contains "a timeline tells a loss and its recovery" "recovered in" "$(cat "$work/timeline")"
expect "a pipe gets no colour" 0 "$(grep -c $'\x1b' "$work/timeline")"
LC_ALL=C "$relock" timeline "$work/a" >"$work/timeline.c"
expect "another locale gets letters" 0 "$(LC_ALL=C grep -c -P '[\x80-\xFF]' "$work/timeline.c")"
expect "a narrow terminal is not overrun by lanes" 0 \
  "$(COLUMNS=60 LC_ALL=C "$relock" timeline "$work/a" | grep -c -E '^  [a-z]+ +[gHMSW.]{57,}')"

"$relock" score --json "$work/a" | tr -d ' \n' >"$work/json"
expect_contains "scores are JSON too" '"gate":"centre0.25D,hold0.5D"' "$(cat "$work/json")"

# Scoring needs nothing but the results folder, wherever it is.
mv "$work/a" "$work/elsewhere"
"$relock" score "$work/elsewhere" >"$work/scores.c"
expect "results can be moved" "$(cat "$work/scores")" "$(cat "$work/scores.c")"

run --sequence recordings/klahaag-prints --methods aruco,apriltag --protocol detect --out "$work/d"
expect "detectors run without a start" 0 $?
expect "and are judged from the first frame" 0 "$(cd "$work/d" && "$relock" score . >/dev/null; grep -c ',aruco,NotStarted' "$work/d/klahaag-prints/recorded-detect/aruco/verdicts.csv")"
run --sequence recordings/klahaag --methods linear --protocol reset --out "$work/r"
expect "reset starts again after a loss" yes "$((($(grep -c ',given,' "$work/r/klahaag/recorded-reset/linear/trajectory.csv") > 1)) && echo yes)"

frame=recordings/klahaag-prints/images/00001.jpg
line=$("$relock" detect "$frame" --method aruco --json --draw "$work/drawn.png")
expect_contains "detect writes one JSON line a picture" '{"image":"'"$frame"'","width":640,"height":360,"sightings":[{"code":"aruco6x6_250:23","centre":[' "$line"
expect_contains "with the outline" '"outline":{"quad":[[' "$line"
expect "and a drawing" yes "$([[ -s $work/drawn.png ]] && echo yes)"
expect "several pictures are several lines" 2 "$("$relock" detect "$frame" recordings/klahaag/images/00002.jpg --method apriltag --json | wc -l)"

for method in kcf csrt mil aruco apriltag mute still linear oracle; do
  expect_contains "list shows $method" "$method" "$("$relock" list)"
done
expect_contains "list shows options with their units" "px" "$("$relock" list --verbose)"
finish
