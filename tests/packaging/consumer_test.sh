#!/usr/bin/env bash
# Another project finds an installed relock and links its libraries.
# Usage: consumer_test.sh STAGE
set -uo pipefail
source tests/scripts/expect.sh
stage=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake -S tests/packaging/consumer -B "$work" -G Ninja -DCMAKE_PREFIX_PATH="$stage" >"$work.log" 2>&1 &&
  cmake --build "$work" >>"$work.log" 2>&1
expect "it builds" 0 $?
[[ -x $work/consumer ]] || cat "$work.log"
rm -f "$work.log"
expect_contains "it works" "53 frames, " "$("$work/consumer" "$stage/share/relock/recordings/klahaag")"
expect_contains "a relock of its own has its own method" "something at 319.50, 179.50" \
  "$("$work/own_relock" detect "$stage/share/relock/recordings/klahaag/images/00001.jpg" --method everything)"
finish
