#!/usr/bin/env bash
# A flight is made, is a recording, and methods run on it; mistakes are one sentence.
# Usage: simulate_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

said=$("$relock" simulate --preset paper --target ring:01 --target aruco6x6_250:0 --seed 7 --duration 1 --jobs 2 --out "$work/flight")
expect "a flight is made" 0 $?
expect_contains "and told of" "30 frames of 640x360, 1 s at 30 Hz" "$said"
expect_contains "it is a recording" "flight: 30 frames" "$("$relock" inspect "$work/flight" --no-pictures)"
"$relock" run --sequence "$work/flight" --methods aruco --protocol detect --out "$work/results" >/dev/null
expect "methods run on it" 0 $?
expect_contains "and see its markers" "aruco" "$("$relock" score "$work/results")"
expect "it is made again from its own plan" 0 "$("$relock" simulate "$work/flight/flight.toml" --out "$work/again/flight" >/dev/null; echo $?)"
expect "byte for byte" "" "$(diff -r "$work/flight" "$work/again/flight")"

"$relock" simulate --preset canvas --target aruco6x6_250:0 --out "$work/canvas" >/dev/null
expect "a canvas is made" 0 $?
"$relock" run --sequence "$work/canvas" --methods aruco --protocol detect --out "$work/canvas-results" >/dev/null
expect "and methods run on it" 0 $?
"$relock" simulate "$work/canvas/canvas.toml" --out "$work/again/canvas" >/dev/null
expect "a canvas is made again" "" "$(diff -r "$work/canvas" "$work/again/canvas")"

printf 'preset = "stills"\ntargets = ["ring:01", "aruco6x6_250:0"]\nstills = 4\nblurs_px = [0, 30]\nwidth = 320\nheight = 240\nsize_px = [50, 70]\n' >"$work/plan.toml"
expect_contains "stills are made" "4 stills of 320x240 of ring:01, aruco6x6_250:0" "$("$relock" simulate "$work/plan.toml" --seed 3 --out "$work/stills")"
"$relock" run --sequence "$work/stills" --methods aruco --protocol detect --out "$work/stills-results" >/dev/null
expect "and methods run on them" 0 $?
"$relock" simulate "$work/stills/stills.toml" --out "$work/again/stills" >/dev/null
expect "stills are made again" "" "$(diff -r "$work/stills" "$work/again/stills")"

expect_contains "presets are listed" "violent" "$("$relock" simulate --list)"
expect_contains "a plan is shown" "most_rate_deg_s = 500" "$("$relock" simulate --preset violent --show)"

expect_mistake simulate "no folder" "--out FOLDER"
expect_mistake simulate "no preset" 'did you mean "violent"?' --preset violet --out "$work/x"
expect_mistake simulate "no target" "ring" --target rung:01 --out "$work/x"
expect_mistake simulate "a folder that is there" "is there already" --out "$work/flight"
expect_mistake simulate "stills in time" "have no time" --preset stills --duration 3 --out "$work/x"
expect_mistake simulate "stills of one target twice" "asked for twice" --preset stills --target ring:01 --target ring:01 --out "$work/x"
printf '[scene]\nbackground = "none.jpg"\n' >"$work/plan.toml"
expect_mistake simulate "no background" "none.jpg" "$work/plan.toml" --out "$work/x"
printf '[exposure]\ntime_ms = -3\n' >"$work/plan.toml"
expect_mistake simulate "negative exposure" "time_ms is -3" "$work/plan.toml" --out "$work/x"
expect "nothing is left of what failed" "" "$(ls -A "$work" | grep -F x)"

# A disk that fills up half-way: a file system of 1 MB, where one may be mounted.
if mkdir "$work/small" && mount -t tmpfs -o size=1m none "$work/small" 2>/dev/null; then
  expect_mistake simulate "a full disk" "is the disk full?" --duration 3 --out "$work/small/flight"
  expect "and leaves no half sequence" "" "$(ls -A "$work/small")"
  umount "$work/small"
fi
finish
