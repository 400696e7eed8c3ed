#!/usr/bin/env bash
# `relock marker`: sheets in three formats, read back by `relock detect`, and every mistake in one sentence.
# Usage: marker_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
marker() { "$relock" marker "$@"; }

refused() {  # WHAT PART ARGUMENT...: exit 2, one line on stderr that contains PART, no file
  local what=$1 part=$2 said status
  shift 2
  said=$(marker "$@" 2>&1 >/dev/null)
  status=$?
  expect "$what: exit status" 2 "$status"
  expect_contains "$what" "$part" "$said"
  expect "$what: one sentence" 1 "$(wc -l <<<"$said")"
  expect "$what: no file" "" "$(find "$work" -name 'bad*' -o -name '.bad*')"
}

# The issue's own example, and a sheet of everything.
said=$(marker ring:01 --size 150mm -o "$work/marker.pdf")
expect "a ring: exit status" 0 $?
expect_contains "a ring: page" "marker.pdf: 201 x 208.2 mm, 1 marker" "$said"
expect "it is a PDF" "%PDF" "$(head -c 4 "$work/marker.pdf")"
all=ring:00,ring:01,aruco6x6_250:23,apriltag36h11:5
for ending in pdf svg png; do
  marker $all --size 90mm --paper a4 -o "$work/one.$ending" >/dev/null
done
sleep 1.1  # PDF can hold the second in which it was made
mkdir "$work/again"
for ending in pdf svg png; do
  marker $all --size 90mm --paper a4 -o "$work/again/one.$ending" >/dev/null
done
expect "one file for each page" "one-2.png one-2.svg one.pdf one.png one.svg" "$(cd "$work" && echo one*)"
for file in "$work"/one*; do
  expect "the same bytes again: ${file##*/}" 0 "$(cmp "$file" "$work/again/${file##*/}" >/dev/null; echo $?)"
done
expect_contains "SVG has its true size" 'width="595.275591pt" height="841.889764pt"' "$(head -c 300 "$work/one.svg")"

codes() { "$relock" detect "$1" --method "$2" --json | grep -o '"code":"[^"]*"' | cut -d '"' -f 4; }
expect "ArUco reads its marker" aruco6x6_250:23 "$(codes "$work/one-2.png" aruco)"
expect "AprilTag reads its tag" apriltag36h11:5 "$(codes "$work/one-2.png" apriltag)"

if command -v pdfinfo >/dev/null; then
  expect_contains "PDF has A4 pages" "595.276 x 841.89 pts (A4)" "$(pdfinfo "$work/one.pdf")"
  expect_contains "as many as were told" "Pages:           2" "$(pdfinfo "$work/one.pdf")"
  expect_contains "PDF is just as large as its marker" "569.764 x 590.173 pts" "$(pdfinfo "$work/marker.pdf")"
  expect_contains "captions can be read" "diameter 150 mm" "$(pdftotext "$work/marker.pdf" -)"
  marker ring:01 --size 150mm --no-caption -o "$work/bare.pdf" >/dev/null
  expect_contains "without caption it is a square" "569.764 x 569.764 pts" "$(pdfinfo "$work/bare.pdf")"
fi
marker ring:0,ring:1 --size 20mm --geometry 0.1-0.3,0.5-0.6,0.8-1 -o "$work/own.svg" >/dev/null 2>"$work/said"
expect "unequal rings are told once" "relock: the rings 0.1-0.3,0.5-0.6,0.8-1 are not equally wide; a reader must be told these radii to read them" "$(cat "$work/said")"
marker ring:0 --size 20mm -o "$work/upright.svg" >/dev/null
marker ring:0 --size 20mm --inverted -o "$work/inverted.svg" >/dev/null
expect "inverted is another picture" 1 "$(cmp -s "$work/upright.svg" "$work/inverted.svg"; echo $?)"

bad="$work/bad.pdf"
refused "no such family" 'no markers are called "rnig" (did you mean "ring"?)' rnig:01 --size 150mm -o "$bad"
refused "a misspelt dictionary" '(did you mean "aruco6x6_250"?)' aruco6x6_25:1 --size 150mm -o "$bad"
refused "bits that are none" '"02" are no bits of a ring marker' ring:02 --size 150mm -o "$bad"
refused "too many bits" '"0101010" are no bits' ring:0101010 --size 150mm -o "$bad"
refused "another number of bits" 'ring3:01 has 2 bits; write ring:01 or ring2:01' ring3:01 --size 150mm -o "$bad"
refused "no such marker" 'the dictionary 6x6_250 has no marker 250; its markers are 0 to 249' aruco6x6_250:250 --size 150mm -o "$bad"
refused "no name" 'no markers are called ""' ring:01, --size 150mm -o "$bad"
refused "no size" '--size is required' ring:01 -o "$bad"
refused "size zero" '--size is 0mm; it must be from 1mm to 10m' ring:01 --size 0mm -o "$bad"
refused "size without unit" '--size is "150"; write a number and mm, cm, m or in' ring:01 --size 150 -o "$bad"
refused "no such ending" 'bad.gif must end in .pdf, .svg or .png' ring:01 --size 150mm -o "$work/bad.gif"
refused "no such paper" '--paper is "a44" (did you mean "a4"?)' ring:01 --size 150mm --paper a44 -o "$bad"
refused "too large for the paper" 'ring:01 of 160 mm needs 214.4 x 221.6 mm with its margins, and a4 has 202 x 289 mm' ring:01 --size 160mm --paper a4 -o "$bad"
refused "no such geometry" 'the geometry "evn" is none' ring:01 --size 150mm --geometry evn -o "$bad"
refused "radii that fall" 'must rise from ring to ring, and 0.7-0.6 does not' ring:0 --size 150mm --geometry 0.1-0.2,0.7-0.6,0.8-1 -o "$bad"
refused "too few radii" 'has 3 rings; 2 bits need 4' ring:00 --size 150mm --geometry 0.1-0.2,0.5-0.6,0.8-1 -o "$bad"
refused "a quiet zone inside the rings" 'option quiet_zone is "0.5"; it must be a number from 1 to 4' ring:00 --size 150mm --quiet-zone 0.5 -o "$bad"
refused "an inverted square" '--inverted is for ring markers, and aruco6x6_250:1 is none' ring:01,aruco6x6_250:1 --inverted --size 50mm -o "$bad"
refused "a geometry without rings" 'are for ring markers, and there is none' aruco6x6_250:1 --geometry even --size 50mm -o "$bad"
refused "too coarse" 'dots wide at 20 dpi, and 2 are needed' ring:01 --size 10mm --dpi 20 -o "$work/bad.png"
refused "too fine" 'more than fit into memory; lower --dpi' ring:01 --size 500mm --dpi 4800 -o "$work/bad.png"
refused "dpi of zero" '--dpi is 0; it must be from 20 to 4800' ring:01 --size 50mm --dpi 0 -o "$work/bad.png"
refused "no such folder" "the folder $work/nowhere does not exist" ring:01 --size 50mm -o "$work/nowhere/bad.pdf"
mkdir "$work/folder.pdf"
refused "a folder in its place" 'is no file that could be replaced' ring:01 --size 50mm -o "$work/folder.pdf"
# A disk that is full: files end after 1 kB. Nothing half-written stays.
said=$(trap '' XFSZ; ulimit -f 1; marker ring:01 --size 50mm -o "$work/bad.png" 2>&1 >/dev/null)
expect "disk full: exit status" 2 $?
expect_contains "disk full" "bad.png cannot be written; is the disk full" "$said"
expect "disk full: no file" "" "$(find "$work" -name '*bad*')"
said=$(marker ring:01 --size 50mm -o "$work/good.pdf" 2>&1 >/dev/full)
expect "full where it reports to: exit status" 2 $?
expect_contains "full where it reports to" "the output cannot be written" "$said"

# A coloured sheet is printed in its colour, and told from a black one.
"$relock" marker ring:01-red,ring:01-blue --size 40mm --dpi 100 -o "$work/colour.png" >/dev/null
expect "coloured sheets are printed" 0 $?
for file in "$work"/colour*.png; do "$relock" detect "$file" --method "ring(colours=true)" | grep -o 'ring2:[^ ]*'; done >"$work/read"
expect "and read" "ring2:01-blue ring2:01-red" "$(sort "$work/read" | tr '\n' ' ' | sed 's/ $//')"
expect_mistake marker "a colour that is none" "red, green and blue" ring:01-pink --size 40mm -o "$work/pink.png"
expect_mistake marker "a coloured inverted marker" "no colour" "ring(inverted=true):01-red" --size 40mm -o "$work/pink.png"
finish
