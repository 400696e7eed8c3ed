#!/usr/bin/env bash
# Every mistake is one sentence that names the place, exit 2, and nothing already computed is lost.
# Usage: errors_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

refused() {  # WHAT PART COMMAND...: exit 2, one line on stderr that contains PART
  local what=$1 part=$2 said status
  shift 2
  said=$("$@" 2>&1 >/dev/null)
  status=$?
  expect "$what: exit status" 2 "$status"
  expect_contains "$what" "$part" "$said"
  expect "$what: one sentence" 1 "$(wc -l <<<"$said")"
}
run() { "$relock" run --out "$work/out" "$@"; }
clip=recordings/klahaag

refused "no such recording" "nowhere does not exist" run --sequence nowhere --methods kcf
refused "no such method" 'no method is called "crst" (did you mean "csrt"?)' run --sequence $clip --methods crst
refused "no such option" 'kcf has no option "detect_tresh" (did you mean "detect_thresh"?)' run --sequence $clip --methods 'kcf(detect_tresh=1)'
refused "an option out of range" 'kcf: option detect_thresh is "7"; it must be a number from' run --sequence $clip --methods 'kcf(detect_thresh=7)'
refused "a network without its file" "goturn: option model is not given" run --sequence $clip --methods goturn
refused "a network's file that does not exist" "option model is nowhere.onnx, which does not exist" run --sequence $clip --methods 'dasiamrpn(model=nowhere.onnx)'
refused "a file that is no network" "README.md is no network that OpenCV" run --sequence $clip --methods 'dasiamrpn(model=README.md,kernel_cls1=README.md,kernel_r1=README.md)'
refused "a network that is too new or has no file" "vit" run --sequence $clip --methods vit
refused "no such verb" 'there is no verb "tmeline" (did you mean "timeline"?)' "$relock" tmeline
refused "no such protocol" 'no protocol is called "twice"' run --sequence $clip --methods kcf --protocol twice
refused "a tracker without a start" "kcf needs a box to start from" run --sequence $clip --methods kcf --protocol detect
refused "no such pattern" 'the gap pattern "papr" is not known' run --sequence $clip --methods kcf --gaps papr
refused "no labels" "no-labels.csv cannot be read" run --sequence $clip --methods kcf --labels "$work/no-labels.csv"
refused "a detector without a code to read" "aruco reads codes of aruco6x6_250" run --sequence $clip --methods aruco
refused "a detector without stages" "apriltag does not show its stages; these detectors do: " "$relock" detect $clip/images/00001.jpg --method apriltag --explain
refused "a folder for stages that nobody asked for" "--out requires --explain" "$relock" detect $clip/images/00001.jpg --method aruco --out "$work/stages"
refused "no results" "is no folder of results" "$relock" score "$work/none"

mkdir "$work/clip"
cp -r $clip/images $clip/recording.toml "$work/clip"
sed 's/^52,/4071,/' $clip/labels.csv >"$work/clip/labels.csv"
refused "labels of another recording" "labels.csv:54: frame 4071 does not exist in klahaag (it has 53 frames, from 0)" run --sequence "$work/clip" --methods kcf
sed '11s/shirt,visible,[0-9.]*/shirt,visible,2600/' $clip/labels.csv >"$work/clip/labels.csv"
refused "a box outside the picture" "labels.csv:11: the target at x 2600.0 to" run --sequence "$work/clip" --methods kcf
sed '11s/shirt,visible,[0-9.]*/shirt,visible,nan/' $clip/labels.csv >"$work/clip/labels.csv"
refused "a box that is not a number" 'labels.csv:11: column x: "nan" is no finite number' run --sequence "$work/clip" --methods kcf
sed '1s/width/widht/' $clip/labels.csv >"$work/clip/labels.csv"
refused "a column of another name" 'labels.csv:1: the column "width" is missing (is it the one called "widht"?)' run --sequence "$work/clip" --methods kcf
cp $clip/labels.csv "$work/clip"
{ echo timestamp_ns; for i in $(seq 1 53); do echo $((i == 20 ? 5 : i * 33000000)); done; } >"$work/clip/timestamps.csv"
refused "a time that goes backwards" "timestamps.csv:21: the time 5 goes back behind" run --sequence "$work/clip" --methods kcf
rm "$work/clip/timestamps.csv"

# An unreadable picture in the middle: what came before is kept, and can be scored.
head -c 5000 $clip/images/00031.jpg >"$work/clip/images/00031.jpg"
refused "an unreadable picture" "00031.jpg: this picture is cut off after 5000 bytes (what was seen of the 30 frames before it is kept in" \
  "$relock" run --sequence "$work/clip" --methods still --out "$work/cut"
expect_contains "what was seen is scored" "could not be read beyond frame 30" "$("$relock" score "$work/cut" 2>&1)"
cp $clip/images/00031.jpg "$work/clip/images"

# The place for results.
mkdir "$work/mine"
echo precious >"$work/mine/thesis.txt"
refused "a folder of something else" "holds files that are not relock's" "$relock" run --sequence $clip --methods kcf --out "$work/mine"
expect "and it is left alone" precious "$(cat "$work/mine/thesis.txt")"
refused "a file in its place" "is a file; results need a folder" "$relock" run --sequence $clip --methods kcf --out "$work/mine/thesis.txt"
refused "a folder that cannot be made" "cannot be made" "$relock" run --sequence $clip --methods kcf --out /proc/relock
run --sequence $clip --methods still >/dev/null
sed -i '5s/visible,257/visible,256/' "$work/clip/labels.csv"
refused "results of other labels" "was made from other pictures, times or labels than klahaag has now" run --sequence "$work/clip" --methods still
if [[ -w /dev/full ]]; then
  mkdir -p "$work/full/small"
  if mount -t tmpfs -o size=64k tmpfs "$work/full/small" 2>/dev/null; then
    refused "a full disk" "cannot be written; is the disk full" "$relock" run --sequence $clip --methods still --out "$work/full/small/out"
    umount "$work/full/small"
  fi
fi

# A results file that was tampered with.
sed -i '9s/^[0-9]*,/77,/' "$work/out/klahaag/recorded-once/still/trajectory.csv"
refused "a row out of order" "trajectory.csv:9: frame 77 comes after frame 6" "$relock" score "$work/out"
for verb in "timeline" "explain" "survival" "attribute --json" "compatibility" "export --as otb --out $work/exported"; do
  # shellcheck disable=SC2086  # verbs with their options
  refused "a row out of order, to ${verb%% *}" "frame 77 comes after frame 6; every recorded frame must be there, in order (left out)" "$relock" $verb "$work/out"
done
for verb in "timeline" "explain" "survival" "attribute --json" "compatibility"; do
  # shellcheck disable=SC2086
  told=$("$relock" $verb "$work/out" 2>/dev/null)
  expect_contains "${verb%% *} tells of the others" mute "$told"
  expect "${verb%% *} does not tell of that run" 0 "$(grep -c -E '^ +still|"still"' <<<"$told")"
done
expect "export writes the others" "linear mute oracle" "$(cd "$work/exported" && echo *)"
rm "$work"/out/klahaag/recorded-once/{linear,mute,oracle}/trajectory.csv
"$relock" survival "$work/out" >"$work/nothing" 2>"$work/said"
expect "where nothing can be read, that is the exit status" 2 $?
expect "each run has its sentence" 4 "$(grep -c '(left out)$' "$work/said")"
expect "and nothing else is said" "" "$(cat "$work/nothing")"

# Names that need quoting, and conditions that do not belong in one table.
mkdir -p "$work/odd"
cp -r $clip/images "$work/odd"
printf 'name = "bob\'"'"'s \\"7\\""\nrate_hz = 30\n' >"$work/odd/recording.toml"
sed 's/,shirt,/,"shirt, red",/' $clip/labels.csv >"$work/odd/labels.csv"
"$relock" run --sequence "$work/odd" --methods still --out "$work/odd-results" >/dev/null
expect_contains "odd names survive" "target shirt, red" "$("$relock" score "$work/odd-results" 2>&1)"

mkdir "$work/t1" "$work/t2"
{ echo timestamp_ns; seq 0 33000000 3300000000; } >"$work/t1/x.csv"
{ echo timestamp_ns; seq 0 33000000 3300000000 | awk 'NR % 5'; } >"$work/t2/x.csv"
"$relock" run --sequence $clip --methods still --gaps "trace($work/t1/x.csv)" --out "$work/traces" >/dev/null
refused "other gaps of the same name" "holds runs under other conditions" \
  "$relock" run --sequence $clip --methods linear --gaps "trace($work/t2/x.csv)" --out "$work/traces"
"$relock" run --sequence $clip --methods linear --protocol reset --gate iou --out "$work/gates" >/dev/null
refused "other gates in one table" "holds runs under other conditions" "$relock" run --sequence $clip --methods still --protocol reset --out "$work/gates"
refused "a gate that resets were not judged by" "were judged by the gate iou" "$relock" score "$work/gates" --gate centre
expect_contains "resets are judged by their own gate" "gate iou 0.5, hold 0.25" "$("$relock" score "$work/gates")"
refused "a rate that is none" "a rate of 1e-300 Hz is none" run --sequence $clip --methods still --rate 1e-300

refused "no such picture" "nothing.png does not exist" "$relock" detect nothing.png --method aruco
refused "no picture" "is no picture that can be read" "$relock" detect README.md --method aruco
refused "a tracker asked to detect" "kcf is no detector" "$relock" detect $clip/images/00001.jpg --method kcf
refused "a method mistyped" "a closing parenthesis is missing" bash -c '"$0" run --sequence recordings/klahaag --methods "kcf(a=1" 2>&1 >/dev/null | head -1 >&2; exit 2' "$relock"
finish
