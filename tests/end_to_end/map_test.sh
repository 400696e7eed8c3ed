#!/usr/bin/env bash
# A map is made, goes on where it stopped, and is the same bytes however it was made.
# Usage: map_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/flight.toml" <<PLAN
preset = "calm"
camera = { width = 200, height = 150 }
motion = { distance_m = 0.5, sway_deg = 8.0, sway_hz = 1.5 }
scene = { clutter = 0.0 }
[[target]]
name = "apriltag36h11:3"
size_m = 0.2
PLAN
methods="medianflow,apriltag"
small=(--flight "$work/flight.toml" --exposures 4,30 --seeds 2 --duration 0.8 --methods "$methods")
map() { "$relock" map "${small[@]}" --across 1,6 "$@"; }
same_maps() {  # A B: all files but the timing are the same, byte for byte, and nothing is left over
  diff --recursive --exclude timing.csv --exclude .lock "$1" "$2" >"$work/difference" && echo same || echo different
}

dry=$(map --dry-run --out "$work/dry")
expect_contains "a dry run counts" "4 cells of 2 seeds: 4 flights of 0.8 s, 0 of them there already; 16 runs, 0 of them" "$dry"
expect "and makes nothing" "" "$(ls "$work/dry" 2>/dev/null)"

said=$(map --jobs 1 --out "$work/one" 2>"$work/errors")
expect "a map is made" 0 $?
expect "quietly in a pipe" "" "$(cat "$work/errors")"
expect_contains "and told" "T tracking (medianflow), D detection (apriltag)" "$said"
expect "as files" "map.csv map.json map.png map.svg" "$(cd "$work/one" && echo map.*)"
expect "a row for each cell, method and difference" 13 "$(wc -l <"$work/one/map.csv")"
expect_contains "whose rows are the true blur" "exposure_ms,blur_px,blur_percent,gap_slots" "$(head -1 "$work/one/map.csv")"
map --jobs 2 --out "$work/two" >/dev/null
expect "jobs do not matter" same "$(same_maps "$work/one" "$work/two")"

# Interrupted when some flights are there, and again when some runs are; then finished.
wait_for() {  # PATTERN: until such a file is in the stopped map
  for _ in $(seq 400); do [[ -n $(find "$work/stopped" -path "$1" -not -path '*/.*' 2>/dev/null) ]] && return; sleep 0.02; done
}
stop_at() {  # PATTERN SIGNAL
  "$relock" map "${small[@]}" --across 1,6 --jobs 2 --out "$work/stopped" >"$work/stopped.txt" 2>&1 &
  local victim=$!
  wait_for "$1"
  kill "-$2" $victim 2>/dev/null
  wait $victim 2>/dev/null
}
stop_at "*/flights/*/flight.toml" KILL
expect "it was killed between flights" yes "$([[ $(find "$work/stopped/flights" -name flight.toml -not -path '*/.*' | wc -l) -lt 4 ]] && echo yes)"
made() { stat -c %y -- "$work/stopped/flights/exposure-4-seed-1/flight.toml"; }
first=$(made)
stop_at "*/runs/*/run.json" INT
expect "it was interrupted between runs" yes "$([[ $(find "$work/stopped/runs" -name run.json -not -path '*/.*' | wc -l) -lt 16 ]] && echo yes)"
expect_contains "which is told" "the same command goes on from there" "$(cat "$work/stopped.txt")"
map --out "$work/stopped" >/dev/null
expect "the map is finished" 0 $?
expect "and is what it would have been" same "$(same_maps "$work/one" "$work/stopped")"
expect "flights are not made twice" "$first" "$(made)"

said=$("$relock" map "${small[@]}" --axes size,blur --across 24,48 --out "$work/size")
expect "sizes are mapped" 0 $?
expect_contains "by blur in pixels" "mean blur, px" "$said"
said=$("$relock" map "${small[@]}" --axes rate,blur --across 10,30 --out "$work/one")
expect "rates are mapped" 0 $?
expect_contains "from flights that are there" "frame rate, Hz" "$said"

expect_mistake map "no axes" "they are gap,blur, rate,blur and size,blur" --axes blur,gap
expect_mistake map "flights too short" "--duration must be 0.5 s or more" --duration 0.2
expect_mistake map "no detector" "--methods names no detector" --methods kcf,csrt
expect_mistake map "an unknown method" 'did you mean "csrt"?' --methods crst,apriltag
expect_mistake map "a detector that reads other codes" "reads codes of" --methods kcf,aruco --duration 0.5 --seeds 1 --exposures 4 --across 1 --out "$work/codes"
expect_mistake map "an exposure too long" "--exposures has 50" --exposures 50
expect_mistake map "a tracker that is not there" "--tracker csrt" --methods kcf,apriltag --tracker csrt
expect_mistake map "other flights" "was flown by another plan" --out "$work/one" "${small[@]}" --target apriltag36h11:4
finish
