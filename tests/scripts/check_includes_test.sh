#!/usr/bin/env bash
# Tests that scripts/check-includes and scripts/check-lengths find what is planted, and nothing else.
# Usage: tests/scripts/check_includes_test.sh
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/scripts
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

house=$(mktemp -d)
trap 'rm -r "$house"' EXIT

found() {  # FILE LINE: what is complained about when the file has this line
  mkdir -p "$house/$(dirname "$1")"
  echo "$2" >"$house/$1"
  "$scripts/check-includes" "$house" || true
  rm "$house/$1"
}

allowed() { expect "$1 may have $2" "" "$(found "$1" "$2")"; }
forbidden() { expect_contains "$1 may not have $2" "$1:1: " "$(found "$1" "$2")"; }

allowed core/csv.cpp '#include "core/csv.h"'
allowed eval/scores.cpp '#include "core/time.h"'
allowed eval/scores.cpp '#include "eval/scores.h"'
allowed eval/scores.cpp '#include <vector>'
allowed eval/scores.cpp '// #include "cli/program.h"'
allowed detectors/aruco.cpp '#include "marker_cells.h"'
allowed detectors/aruco.cpp '#include <opencv2/core.hpp>'
allowed cli/run.cpp '#include "eval/scores.h"'
allowed tests/eval/scores_test.cpp '#include "cli/program.h"'

forbidden core/csv.cpp '#include "eval/scores.h"'
forbidden eval/scores.cpp '#include "trackers/builtin.h"'
forbidden eval/deeper/scores.cpp '  #  include <sequences/open.h>'
forbidden detectors/aruco.h '#include "trackers/builtin.h"'
forbidden trackers/builtin.cpp '#include "cli/program.h"'
forbidden sequences/open.cpp '#include "../eval/scores.h"'
forbidden sequences/open.cpp '#include "tests/builders.h"'
forbidden cli/main.cpp '#include <opencv2/opencv.hpp>'

mkdir -p "$house/core"
seq 450 >"$house/core/long.cpp"
expect "450 lines are allowed" "" "$("$scripts/check-lengths" "$house" || true)"
seq 451 >"$house/core/long.cpp"
expect_contains "451 lines are not" "core/long.cpp" "$("$scripts/check-lengths" "$house" || true)"

finish
