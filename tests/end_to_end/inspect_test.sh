#!/usr/bin/env bash
# `relock inspect` on the embedded recordings and on odd ones.
# Usage: inspect_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
inspect() { "$relock" inspect "$@" 2>&1; }

said=$(inspect recordings/klahaag)
expect "it ends well" 0 $?
expect_contains "frames, size, duration" "klahaag: 53 frames of 640x360, 1.73 s" "$said"
expect_contains "label accuracy" "shirt's labels are good to 0.7 px: localization finer than 1.4 px is not shown" "$said"
expect_contains "too short" "5 s of follow-up wanted" "$said"
expect_contains "a recording by its name" "klahaag: 53 frames" "$(inspect klahaag --no-pictures)"
expect "without pictures nothing is estimated" 0 "$(inspect klahaag --no-pictures | grep -c estimated)"
expect_contains "true blur of the labels" "true, of the labels" "$(inspect klahaag-prints --no-pictures)"

json=$(inspect recordings/klahaag-prints --json | tr -d ' \n')
expect_contains "JSON" '"recording":"klahaag-prints","format":"folder","times_from":"statedrate","frames":53' "$json"
expect_contains "n/a is null" '"longest_gap":null' "$json"
expect "an estimate for each frame and each target, and for each picture" $((4 * 53)) "$(grep -o '"direction_rad"' <<<"$json" | wc -l)"

mkdir -p "$work/clip/images"
frame() { printf -v name '%05d.jpg' "$1"; cp "recordings/klahaag/images/$name" "$work/clip/images"; }
expect_contains "no pictures" "holds no pictures" "$(inspect "$work/clip")"
frame 1
expect_contains "no times" "says nothing of time" "$(inspect "$work/clip")"
said=$(inspect "$work/clip" --rate 30)
expect_contains "one frame" "one frame: there is nothing to follow" "$said"
expect_contains "no labels" "no labels: nothing can be scored" "$said"
frame 2
expect_contains "two frames" "2 frames of 640x360, 0.03 s" "$(inspect "$work/clip" --rate 30)"
printf 'frame,target,label\n0,cat,absent\n1,cat,absent\n' >"$work/clip/labels.csv"
said=$(inspect "$work/clip" --rate 30)
expect_contains "all absent" "cat is never visible: it cannot be scored" "$said"
rm "$work/clip/labels.csv"
for i in 3 4 5 6 7; do frame $i; done
printf 'timestamp_ns\n0\n33000000\n66000000\n198000000\n231000000\n264000000\n297000000\n' >"$work/clip/timestamps.csv"
said=$(inspect "$work/clip")
expect_contains "a gap" "1 gap; 33.3 % of all slots missing; the longest is 4 slots, 0.132 s, before frame 3 at 0.198 s" "$said"
expect_contains "fit for gaps" "gaps as recorded: 1 of 6 intervals, up to 4 slots" "$said"
printf 'timestamp_ns\n0\n33000000\n33000000\n198000000\n231000000\n64000000\n297000000\n' >"$work/clip/timestamps.csv"
said=$(inspect "$work/clip")
expect "times that do not rise: exit status" 2 $?
expect_contains "and all of them" "2 of the capture times do not rise (line 4 repeats, line 7 goes back by 167.000 ms)" "$said"
rm "$work/clip/timestamps.csv"
head -c 5000 recordings/klahaag/images/00005.jpg >"$work/clip/images/00005.jpg"
said=$(inspect "$work/clip" --rate 30)
expect "a picture that cannot be read: exit status" 2 $?
expect_contains "names it" "00005.jpg: this picture is cut off" "$said"
expect_contains "and tells the rest all the same" "intervals, slots of T" "$said"
finish
