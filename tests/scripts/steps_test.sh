#!/usr/bin/env bash
# Tests that scripts/steps.sh lets no failure pass and counts what the test runners counted.
# Usage: tests/scripts/steps_test.sh
set -euo pipefail
steps=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/scripts/steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

run() {  # SCRIPT
  status=0
  said=$(bash -c "set -euo pipefail; source '$steps'; $1; closing" 2>&1) || status=$?
  last=$(tail -n 1 <<<"$said")
}

run 'step one true; step two echo 5 passed, 0 failed'
expect "all well: exit code" 0 "$status"
expect "all well: a step without tests counts as one" "6 passed, 0 failed" "$last"

run 'step one true; step two false || true; step three false || true; step four true'
expect "a failure: exit code" 1 "$status"
expect "a failure: the others still run" "2 passed, 2 failed" "$last"
expect_contains "a failure: the first is named" "First to fail: two" "$said"

run 'step tests bash -c "echo \" 1 FAILED TEST\"; echo \"75% tests passed, 1 tests failed out of 4\"; exit 8" || true'
expect "ctest: its own count is taken" "3 passed, 1 failed" "$last"

run 'step tests bash -c "echo \"[  PASSED  ] 7 tests.\"; echo \" 2 FAILED TESTS\"; exit 1" || true'
expect "GoogleTest: its own count is taken" "7 passed, 2 failed" "$last"

run 'step tests bash -c "echo \"[  PASSED  ] 7 tests.\"; exit 139" || true'
expect "a crash after the tests: fails" 1 "$status"
expect "a crash after the tests: is counted" "7 passed, 1 failed" "$last"

finish
