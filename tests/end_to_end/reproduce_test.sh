#!/usr/bin/env bash
# The paper's experiments are run again, quickly, and told beside what the paper prints.
# Usage: reproduce_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=$work/reproduction-quick

said=$("$relock" reproduce --quick --jobs 2 --out "$out" 2>"$work/errors")
expect "it is reproduced" 0 $?
expect "quietly in a pipe" "" "$(cat "$work/errors")"
for title in "Figure 3" "Figure 8" "Figure 9" "Figure 10" "Figure 11" "Table 1" "Figure 13" "Figure 14" "Gaps or blur"; do
  expect_contains "$title is told, and marked" "$title QUICK: " "$said"
done
expect "no title is without the mark" "" "$(grep -E '^((Figure|Table) [0-9]+|Gaps or blur):' <<<"$said")"
expect_contains "figure 3 has the paper's rates" "ARTag, printed" "$said"
expect "beside ours with intervals" 2 "$(grep -cE '^ +(arucooriginal|aruco4x4_50):7( +[0-9]+ \[[0-9]+, [0-9]+\]){2}$' <<<"$said")"
expect_contains "table 1 has the paper's errors" "2.42 ± 1.05" "$said"
expect_contains "a tracker that looks at no clock is told from one that does" "looks at no clock" "$said"
expect_contains "the losses at gaps are counted by displacement" "0.5 to 0.75 D" "$said"
expect_contains "the files are told" "All of it is in $out" "$said"
expect "what was printed is kept" yes "$([[ $said == "$(cat "$out/reproduction.txt")"* ]] && echo yes)"
for picture in figure-8 figure-9 figure-10 figure-13 figure-14; do
  expect "$picture is a picture" "PNG" "$(head -c 4 "$out/$picture-QUICK.png" 2>/dev/null | tail -c 3)"
done
if command -v gnuplot >/dev/null; then
  for plot in figure-3 figure-11 table-1 gaps-or-blur; do
    expect "$plot is a plot" "$plot-QUICK.pdf $plot-QUICK.png $plot-QUICK.svg" "$(cd "$out" && echo "$plot"-QUICK.*)"
    expect "$plot is marked" yes "$(grep -q QUICK "$out/$plot-QUICK.svg" && echo yes)"
  done
fi
expect "no file of a figure is without the mark" "" "$(find "$out" -maxdepth 1 \( -name 'figure-*' -o -name 'table-*' -o -name 'gaps-*' \) -not -name '*QUICK*')"
expect_contains "all figures are there for programs" '"id": "figure-11"' "$(cat "$out/reproduction.json")"

# It goes on from what is there.
answers=$(find "$out/recognition" -name 'aruco4x4_50-7.csv')
kept=$(find "$out/recognition" -name 'aruco6x6_250-7.csv')
before=$(cat "$answers") made=$(stat -c %y "$kept") figures=$(cat "$out/reproduction.json")
rm "$answers"
json=$("$relock" reproduce --quick --out "$out" --only figure-3 --json)
expect "one experiment is run again" 0 $?
expect "what was missing is the same again" "$before" "$(cat "$answers")"
expect "what was there is kept" "$made" "$(stat -c %y "$kept")"
expect "its figures are printed" "$json" "$(cat "$out/reproduction.json")"
perl scripts/check-documentation --beside "$out" "$relock" docs/reproducing.md
expect "all of it is what the page shows" 0 $?
expect "and all figures are as before" "$figures" "$(cat "$out/reproduction.json")"

said=$(PATH=/nonexistent "$relock" reproduce --quick --out "$out" --only figure-3)
expect "without gnuplot it goes on" 0 $?
expect_contains "and says so" "no gnuplot" "$said"

expect_mistake reproduce "an unknown experiment" 'did you mean "figure-11"?' --only figure11
expect_mistake reproduce "no jobs" "--jobs: Value 0 not in range 1 to 256" --jobs 0
expect_mistake reproduce "a full one beside a quick one" "holds a quick reproduction, not a full one" --out "$out"
expect_mistake reproduce "another's folder" "holds something else" --out tests
expect_mistake reproduce "a file" "is a file" --out README.md
finish
