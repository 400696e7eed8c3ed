#!/usr/bin/env bash
# The plug-ins of docs/adding-a-*.md, built as they stand there by the commands that stand there.
# Usage: documented_plugins_test.sh STAGE
set -uo pipefail
source tests/scripts/expect.sh
root=$PWD stage=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PATH=$stage/bin:$PATH XDG_DATA_HOME=$work/data CMAKE_GENERATOR=Ninja

block() { awk -v open="^\`\`\`$2\$" '$0 ~ open { inside = 1; next } /^```/ { if (inside) exit } inside' "$root/docs/$1"; }

for method in detector/glint tracker/nearby; do
  page=adding-a-${method%/*}.md name=${method#*/}
  mkdir "$work/$name" && cd "$work/$name" || exit 1
  block "$page" cpp >"$name.cpp"
  block "$page" cmake >CMakeLists.txt
  expect "$page shows one file of at most 60 lines" yes "$([[ $(wc -l <"$name.cpp") -le 60 ]] && echo yes)"
  while IFS= read -r command; do
    bash -c "$command" >said 2>&1
    expect "$page: $command" 0 $?
    [[ $command != "relock list"* ]] || expect_contains "it is listed" "(lib$name.so)" "$(cat said)"
  done < <(block "$page" sh)
  expect "only its entry can be seen" relock_plugin_v1 "$(nm --dynamic --defined-only --format=just-symbols "build/lib$name.so")"
  expect_contains "and it is scored" "$name" "$(relock score results 2>&1)"
  cd "$root" || exit 1
done

# `relock new` writes the same files under another name, and they work as they are.
cd "$work" || exit 1
for kind in detector tracker; do
  relock new "$kind" "my_$kind" --in made >/dev/null
  expect "a new $kind is begun" 0 $?
  cmake -S "made/my_$kind" -B "made/my_$kind/build" >said 2>&1 && cmake --build "made/my_$kind/build" >>said 2>&1
  expect "it builds" 0 $?
  ctest --test-dir "made/my_$kind/build" >said 2>&1
  expect "its tests pass" 0 $?
  expect_contains "it says how to go on" "relock run --sequence klahaag --methods my_$kind" "$(cat "made/my_$kind/README.md")"
  expect "nothing of the example's name is left" "" "$(grep -ril -e glint -e nearby "made/my_$kind" --include='*.*' --exclude-dir=build)"
done
finish
