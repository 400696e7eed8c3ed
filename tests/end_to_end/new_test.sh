#!/usr/bin/env bash
# `relock new` refuses what it should; tests/packaging builds what it writes.
# Usage: new_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

refused() {  # PART ARGUMENT...
  local part=$1 said
  shift
  said=$("$relock" new "$@" --in "$work" 2>&1)
  expect "$*: exit status" 2 $?
  expect_contains "$*" "$part" "$said"
  expect "$*: one sentence" 1 "$(wc -l <<<"$said")"
}
for name in Upper 1st a-b a__b a_ '' ../x 'a b' "$(printf 'a%.0s' {1..41})"; do refused "is no name for a method" detector "$name"; done
for name in kcf mute test relock; do refused "is taken" tracker "$name"; done
refused 'there is no "detectr" to begin' detectr mine
expect "nothing was written" "" "$(ls "$work")"
"$relock" new tracker mine --in "$work/some/where" >"$work/said"
expect "a new one is written, its folders too" 0 $?
expect "all of it" "CMakeLists.txt README.md mine.cpp " "$(cd "$work/some/where/mine" && printf "%s " *)"
echo precious >"$work/some/where/mine/mine.cpp"
"$relock" new tracker mine --in "$work/some/where" 2>/dev/null
expect "one that is there is not overwritten" 2 $?
expect "but left alone" precious "$(cat "$work/some/where/mine/mine.cpp")"
finish
