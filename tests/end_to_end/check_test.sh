#!/usr/bin/env bash
# The methods that come with relock keep their promises, and what is asked wrongly is refused.
# Usage: check_test.sh RELOCK [CHECK_OPTION...]      from the project's root; else a short check of memory
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
shift
(($#)) || set -- --frames 400 --budget 1

said=$("$relock" check --all "$@")
expect "all methods pass" 0 $?
[[ $said == *" failed  "* ]] && grep -e '^[^ ]' -e ' failed  ' <<<"$said"
for method in kcf csrt still linear aruco apriltag; do
  expect_contains "$method was checked" "$method (" "$said"
done
expect "every method has a last line without failures" \
  "$(grep -c '^[^ ].*(' <<<"$said")" "$(grep -c 'passed, 0 failed' <<<"$said")"

json=$("$relock" check 'kcf(resize=false)' --check follows --json | tr -d ' \n')
expect_contains "the result is JSON too" \
  '[{"method":"kcf(resize=false)","kind":"tracker","checks":[{"check":"follows","result":"passed"' "$json"

refused() {  # WHAT PART ARGUMENT...
  local what=$1 part=$2 complaint
  shift 2
  complaint=$("$relock" check "$@" 2>&1 >/dev/null)
  expect "$what: exit status" 2 $?
  expect_contains "$what" "$part" "$complaint"
}
refused "no such method" 'no method is called "kfc" (did you mean "kcf"?)' kfc
refused "no such check" 'no check of kcf is called "blink" (did you mean "blank"?)' kcf --check blink
refused "an option out of range" "kcf: option detect_thresh" 'kcf(detect_thresh=7)'
refused "an end of the scale" "oracle is no method" oracle
refused "no method at all" "name the methods to check" --check blank
refused "too much" "not both" kcf --all
refused "too few frames" "--frames must be at least 20" kcf --frames 3
finish
