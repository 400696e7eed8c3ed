#!/usr/bin/env bash
# Tables of real runs, in every grouping and format; results that were tampered with are left out, the others not.
# Usage: scores_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { "$relock" run "$@" >"$work/said" 2>&1; }
headings() { grep -c ', protocol ' <<<"$1"; }  # TABLES

lossy='trace(recordings/gap_traces/tagslam_test_14_top_left.csv)'
run --sequence recordings/klahaag-prints --methods 'kcf(detect_thresh=0.4),aruco' --gaps "$lossy" --out "$work/prints"
expect "a run ends well" 0 $?
run --sequence recordings/klahaag --methods template --out "$work/shirt"
run --sequence recordings/klahaag --methods template --protocol reset --out "$work/shirt"
expect "and so do two protocols" 0 $?

# Tables.
shirt=$("$relock" score "$work/shirt")
expect "every protocol has its table" 2 "$(headings "$shirt")"
expect_contains "one is of once" "klahaag, as recorded, protocol once, gate centre" "$shirt"
expect_contains "one of reset" "klahaag, as recorded, protocol reset, gate centre" "$shirt"
expect "yardsticks stand at the foot" "template linear mute oracle still" \
  "$(awk '/protocol once/ { on = 1 } /precision/ { exit } on && NF > 8 && $1 != "method" && $2 != "as" { print $1 }' <<<"$shirt" | paste -sd ' ')"
expect "yardsticks have no star" 0 "$(grep -cE '^ +(linear|mute|oracle|still) .*\*' <<<"$shirt")"
both=$("$relock" score "$work/shirt" "$work/prints")
expect "several folders are several tables" 3 "$(headings "$both")"
expect "one folder has one comparison's table" 1 "$(headings "$("$relock" score "$work/shirt/klahaag/recorded-reset")")"
expect "a folder that is named twice counts once" "$shirt" "$("$relock" score "$work/shirt" "$work/shirt")"
expect "and so does a part of it" "$shirt" "$("$relock" score "$work/shirt/klahaag/recorded-once/still" "$work/shirt")"

# Groups, as CSV: protocol,gaps,gate,real_time,latency,by,group,method,score,value,low,high,standing.
csv() { "$relock" score --csv "$@" | sed 's/"[^"]*"/quoted/g'; }
groups() { csv --by "$1" "$work/prints" | awk -F, 'NR > 1 && $7 != "" { print $7 }' | sort -u | paste -sd '|'; }
expect "by recording" "klahaag-prints" "$(groups recording)"
expect "by target" "apriltag (apriltag36h11:5)|aruco (aruco6x6_250:23)|shirt" "$(groups target)"
expect "by code" "apriltag36h11:5|aruco6x6_250:23|without a code" "$(groups code)"
expect_contains "by blur" "to 5 px" "$(groups blur)"
expect_contains "by gap" "1 slot" "$(groups gap)"
expect_contains "by blur, for people" "recognition by length of the true blur" "$("$relock" score --by blur "$work/prints")"
expect_contains "by gap, for people" "recognition by the gap before the frame" "$("$relock" score --by gap "$work/prints")"
expect_contains "by code, for people" "code aruco6x6_250:23" "$("$relock" score --by code "$work/prints")"
said=$("$relock" score --by colour "$work/prints" 2>&1 >/dev/null)
expect "by something else: exit status" 2 $?
expect_contains "by something else" "--by colour is none; there are recording, target, code, blur and gap" "$said"

# Formats.
csv "$work/prints" "$work/shirt" >"$work/csv"
expect "CSV has as many cells in every row" 13 "$(awk -F, '{ print NF }' "$work/csv" | sort -u)"
expect "and no two rows about the same" 0 "$(cut -d , -f 1-9 "$work/csv" | sort | uniq -d | wc -l)"
expect "and a score for each method" 6 "$(awk -F, '$1 == "once" && $2 != "none" && $6 == "" && $9 == "recognition"' "$work/csv" | wc -l)"
expect "oracle recognises everything" 1 "$(awk -F, '$1 == "reset" && $6 == "" && $8 == "oracle" && $9 == "recognition" { print $10 }' "$work/csv")"

"$relock" score --json "$work/prints" "$work/shirt" >"$work/json"
if command -v python3 >/dev/null; then
  expect "JSON parses" 0 "$(python3 -m json.tool "$work/json" >/dev/null 2>&1; echo $?)"
fi
expect_contains "n/a is null" '"false_alarms_per_1000": null' "$(cat "$work/json")"

"$relock" score --latex "$work/prints" "$work/shirt" >"$work/latex"
expect "LaTeX ends what it begins" "$(grep -c '^\\begin{tabular}' "$work/latex")" "$(grep -c '^\\end{tabular}' "$work/latex")"
expect "and begins something" yes "$((($(grep -c '^\\begin' "$work/latex") >= 6)) && echo yes)"
expect_contains "and escapes names" 'kcf(detect\_thresh=0.4) & ' "$(cat "$work/latex")"
expect "and has as many cells in every row" 8 "$(grep '\\\\$' "$work/latex" | sed 's/\\&//g' | tr -cd '&\n' | awk '{ print length }' | sort -u)"
expect "and says nothing outside tables" 0 "$(awk '/^\\begin/ { on = 1 } !on && !/^%/ && NF { print } /^\\end/ { on = 0 }' "$work/latex" | wc -l)"

"$relock" score --markdown "$work/prints" "$work/shirt" >"$work/markdown"
expect_contains "Markdown escapes names" '| kcf(detect\_thresh=0.4) | ' "$(cat "$work/markdown")"
expect "and has as many cells in every row" 10 "$(grep '^|' "$work/markdown" | tr -cd '|\n' | awk '{ print length }' | sort -u)"

# What was tampered with. The table of protocol once would be lost with its yardsticks, so that of reset stays.
once=klahaag/recorded-once
left_out() {  # WHAT PART: one sentence with PART, exit 2, and tables
  local said status
  "$relock" score "$work/bad" "$work/prints" >"$work/tables" 2>"$work/errors"
  status=$?
  said=$(cat "$work/errors")
  expect "$1: exit status" 2 "$status"
  expect_contains "$1" "$2" "$said"
  expect "$1: one sentence" 1 "$(wc -l <"$work/errors")"
  expect_contains "$1: other runs are scored" "klahaag-prints, gaps trace" "$(cat "$work/tables")"
}
runs_left() { expect "$1: the runs beside it are scored" 2 "$(grep -cE '^ +oracle .* - *$' <(sed -n '/protocol once, gate.*0.5 D$/,/precision/p' "$work/tables"))"; }
tamper() {  # FILE COMMAND...: the file of a fresh copy through a filter
  rm -rf "$work/bad"
  cp -r "$work/shirt" "$work/bad"
  "${@:2}" <"$work/shirt/klahaag/$1" >"$work/bad/klahaag/$1"
}
still=recorded-once/still/trajectory.csv

tamper $still awk 'NR == 9 { held = $0; next } { print } NR == 10 { print held }'
left_out "rows out of order" "still/trajectory.csv:9: frame 8 comes after frame 6; every recorded frame must be there, in order"
runs_left "rows out of order"
tamper $still awk '{ print } NR == 9'
left_out "a repeated row" "still/trajectory.csv:10: this row of frame 7 is there twice; remove one, or run again"
tamper $still awk '{ print } NR == 2'
left_out "a repeated start" "still/trajectory.csv:3: this row of frame 0 is there twice"
tamper recorded-once/mute/trajectory.csv awk '{ print } NR == 9'
left_out "a repeated silence" "mute/trajectory.csv:10: this row of frame 7 is there twice"
tamper $still awk '{ print } END { sub(/^[0-9]+/, "53"); print }'
left_out "a frame that does not exist" "still/trajectory.csv:55: frame 53 does not exist in klahaag (it has 53 frames, from 0)"
tamper $still sed '2s/^0/-1/'
left_out "a frame below the first" "still/trajectory.csv:2: frame -1 does not exist in klahaag"
tamper $still awk -F, -v OFS=, 'NR == 9 { $7 = "nan" } { print }'
left_out "a coordinate that is none" 'still/trajectory.csv:9: column centre_x: "nan" is no finite number'
tamper $still awk -F, -v OFS=, 'NR == 9 { $12 = "inf" } { print }'
left_out "an outline that is none" 'still/trajectory.csv:9: column x: "inf" is no finite number'
tamper $still sed '1s/centre_x/center_x/'
left_out "a column of another name" 'still/trajectory.csv:1: the column "centre_x" is missing (is it the one called "center_x"?)'
tamper $still sed '9s/^\([0-9]*\),\([0-9]*\)/\1,12345/'
left_out "a time of another recording" "is this trajectory of another recording?"
tamper $still head -c 2000
left_out "cut off in a row" "still/trajectory.csv:"
tamper $still head -n 30
left_out "cut off after a row" "still/trajectory.csv ends at frame 29 of 53; it was cut off: remove its folder and run again"
tamper $still head -c -2
left_out "cut off in the last row" "still/trajectory.csv"
tamper $still head -c 0
left_out "nothing in it" "still/trajectory.csv: the file is empty; it needs a header line"
tamper recorded-once/still/run.json sed 's/\("fingerprint": "\)..../\10000/'
left_out "a run on another recording" "still/run.json was made from other pictures, times or labels than the truth in"
runs_left "a run on another recording"
tamper recorded-once/still/run.json head -c 100
left_out "no JSON" "still/run.json is no run.json of this relock"
tamper recorded-once/linear/run.json tr '{' '['
left_out "no JSON in the first run" "linear/run.json is no run.json of this relock"

# The truth is of all runs on the recording: one sentence, however many.
shirt_is_out() { expect "$1: no table of its recording" 0 "$(grep -c 'klahaag,' "$work/tables")"; }
tamper recording/labels.csv awk -F, -v OFS=, 'NR == 11 { $12 = 2600 } { print }'
left_out "labels outside the picture" "recording/labels.csv:11: the target at x 2600.0 to"
shirt_is_out "labels outside the picture"
tamper recording/recording.toml sed 's/^width = .*/width = 200/'
left_out "labels made for a larger picture" "recording/labels.csv:2: the target at x "
tamper recording/recording.toml sed 's/^width = .*/width = 1280/; s/^height = .*/height = 720/'
left_out "labels made for a smaller picture" "recording/recording.toml was changed after the runs beside it were made"
tamper recording/labels.csv sed '11s/,visible/,absent/'
left_out "labels changed" "recording/labels.csv was changed after the runs beside it were made; change it where the recording is and run again"
tamper recording/timestamps.csv awk 'NR == 20 { $0 = 5 } { print }'
left_out "a time that goes back" "recording/timestamps.csv:20: the time 5 goes back behind"
shirt_is_out "a time that goes back"
tamper recording/recording.toml sed 's/^width/widht/'
left_out "a description mistyped" "recording/recording.toml"
rm "$work/bad/klahaag/recording/labels.csv"
left_out "no labels" "recording/"

"$relock" score "$work/bad" >"$work/tables" 2>"$work/errors"
expect "nothing left to score: exit status" 2 $?
expect "nothing left to score: no table" 0 "$(wc -l <"$work/tables")"
finish
