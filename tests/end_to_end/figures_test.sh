#!/usr/bin/env bash
# Timelines as figures for papers: as large as asked, with their fonts, the same bytes each time.
# Usage: figures_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$relock" run --sequence recordings/klahaag --methods kcf,template --gaps 'bernoulli(0.3)' --out "$work/runs" >/dev/null
figure() { "$relock" timeline "$work/runs" "$@" 2>&1; }

expect "a figure is drawn and nothing printed" "" "$(figure --pdf "$work/a.pdf" --svg "$work/a.svg" --png "$work/a.png")"
figure --pdf "$work/b.pdf" --svg "$work/b.svg" --png "$work/b.png"
for ending in pdf svg png; do
  expect "the same bytes again: $ending" same "$(cmp -s "$work/a.$ending" "$work/b.$ending" && echo same)"
done
expect_contains "two columns wide" 'width="174mm"' "$(head -c 600 "$work/a.svg")"
for text in gaps kcf template 'time \[s\]' Hit dropped; do
  expect "the figure says $text" 1 "$(grep -c ">$text<" "$work/a.svg")"
done
expect "yardsticks are left out" 0 "$(grep -c ">still<" "$work/a.svg")"
figure --svg "$work/c.svg" --method still --method kcf --width-mm 85 --height-mm 50
expect_contains "one column wide, and as high as asked" 'width="85mm" height="50mm"' "$(head -c 600 "$work/c.svg")"
expect "the methods that are named" "still kcf" "$(grep -oE '>(still|kcf|template)<' "$work/c.svg" | tr -d '<>' | paste -sd ' ')"

if command -v pdffonts pdfinfo >/dev/null; then
  expect "the PDF has fonts" yes "$( (($(pdffonts "$work/a.pdf" | tail -n +3 | wc -l) > 0)) && echo yes)"
  expect "and all are embedded" 0 "$(pdffonts "$work/a.pdf" | tail -n +3 | awk '{ print $(NF - 4) }' | grep -vc yes)"
  figure --pdf "$work/c.pdf" --width-mm 85 --height-mm 50
  expect "the PDF is as large as asked, to a point" yes \
    "$(pdfinfo "$work/c.pdf" | awk '/^Page size/ { print ($3 > 239.9 && $3 < 242 && $5 > 140.7 && $5 < 142.8) ? "yes" : $0 }')"
fi

expect_mistake timeline "too low for its lanes" "lanes and their legend need a figure of" "$work/runs" --svg "$work/d.svg" --height-mm 12
expect_mistake timeline "another ending" "--pdf writes .pdf, and" "$work/runs" --pdf "$work/d.svg"
expect_mistake timeline "a size of no figure" "give --svg, --pdf or --png, too" "$work/runs" --width-mm 85
expect_mistake timeline "no such method" 'there is no run of kfc (did you mean "kcf"?)' "$work/runs" --method kfc --svg "$work/d.svg"
"$relock" run --sequence recordings/klahaag --methods kcf --out "$work/runs" >/dev/null
expect_mistake timeline "of two things at once" "a figure is of one recording with one gap pattern, seed and protocol, and there are 2" "$work/runs" --svg "$work/d.svg"
expect "mistakes draw nothing" "" "$(ls "$work"/d.* 2>/dev/null)"
finish
