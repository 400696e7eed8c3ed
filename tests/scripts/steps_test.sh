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

run 'step tests bash -c "echo 5 passed, 0 failed; echo \"100% tests passed, 0 tests failed out of 4\"; echo 20 passed, 0 failed"'
expect "ctest: what is counted after it is more" "24 passed, 0 failed" "$last"

run 'step tests bash -c "echo \"[  PASSED  ] 7 tests.\"; echo \" 2 FAILED TESTS\"; exit 1" || true'
expect "GoogleTest: its own count is taken" "7 passed, 2 failed" "$last"

run 'step tests bash -c "echo \"[  PASSED  ] 7 tests.\"; exit 139" || true'
expect "a crash after the tests: fails" 1 "$status"
expect "a crash after the tests: is counted" "7 passed, 1 failed" "$last"

# A build directory with a fake test program: cases are counted one by one, whatever process they are in.
build=$(mktemp -d)
trap 'rm -r "$build"' EXIT
add_process() {  # WHAT IT DOES
  echo "add_test(process_$((++processes)) bash -c \"$1\")" >>"$build/CTestTestfile.cmake"
}
processes=0
add_process "echo '[  PASSED  ] 7 tests.'"
add_process "true"
run "step tests tests_in '$build'"
expect "cases: are counted one by one" "8 passed, 0 failed" "$last"
add_process "echo '[  PASSED  ] 5 tests.'; echo ' 2 FAILED TESTS'; exit 1"
add_process "echo '[ RUN      ] Case.ThatCrashes'; kill -11 \$\$"
run "step tests tests_in '$build' || true"
expect "cases: those that fail too" "13 passed, 3 failed" "$last"
expect_contains "a crash: names the case" "Case.ThatCrashes" "$said"
run "step tests tests_in '$build' --tests-regex none || true"
expect "no tests at all: fails" "1" "$status"

finish
