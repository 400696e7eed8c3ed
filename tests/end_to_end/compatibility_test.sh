#!/usr/bin/env bash
# Runs go out as the result files of other toolkits and come back with the same scores.
# Usage: compatibility_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

row_of() { awk -v method="$1" '$1 == method {$1 = $1; print}' <<<"$2"; }  # METHOD TABLES
# Without the ninth column, confidence, which result files do not have.
boxes_of() { cut -d , -f 1-8,10- "$1/klahaag/recorded-once/template/trajectory.csv"; }  # RESULTS

"$relock" run --sequence klahaag --methods template --out "$work/results" >"$work/said" 2>&1
expect "run" 0 $?
own=$("$relock" compatibility "$work/results" 2>&1)
expect "compatibility" 0 $?
expect "three tables have template" 3 "$(row_of template "$own" | wc -l)"

for toolkit in otb got10k tum; do
  "$relock" export "$work/results" --as $toolkit --out "$work/$toolkit" >"$work/said" 2>&1
  expect "export as $toolkit" 0 $?
done
expect "a line for each frame" 53 "$(wc -l <"$work/otb/template/klahaag.txt")"
expect "a time for each frame" 53 "$(wc -l <"$work/got10k/template/klahaag/klahaag_time.txt")"
expect "no line for the given frame" 52 "$(wc -l <"$work/tum/template/klahaag.txt")"
expect "the truth beside it" 53 "$(wc -l <"$work/tum/truth/klahaag.txt")"
expect_contains "a mute method" "0,0,0,0" "$(tail -n 1 "$work/otb/mute/klahaag.txt")"
cp -r "$work/results" "$work/untimed"
rm "$work/untimed/klahaag/recorded-once/template/timing.csv"
"$relock" export "$work/untimed" --as otb --out "$work/untimed-otb" >"$work/said" 2>&1
expect "a time for each frame where none was taken" "53 0.00000000" \
  "$(sort "$work/untimed-otb/template/times/klahaag_time.txt" | uniq -c | awk '{ print $1, $2 }')"

for toolkit in otb got10k; do
  file=$(find "$work/$toolkit/template" -name 'klahaag*.txt' ! -name '*_time*')
  "$relock" import "$file" --as $toolkit --sequence klahaag --method template --out "$work/$toolkit-back" >"$work/said" 2>&1
  expect "import as $toolkit" 0 $?
  back=$("$relock" compatibility "$work/$toolkit-back" 2>&1)
  expect "$toolkit: the same scores" "$(row_of template "$own")" "$(row_of template "$back")"
  expect "$toolkit: the same boxes" "$(boxes_of "$work/results")" "$(boxes_of "$work/$toolkit-back")"
done
expect_contains "imported runs are scored on time" "template" "$("$relock" score "$work/otb-back" 2>&1)"

# Protocol vot, there and back.
"$relock" run --sequence klahaag --methods still --protocol vot --out "$work/supervised" >"$work/said" 2>&1
expect "run by VOT's rules" 0 $?
"$relock" export "$work/supervised" --as vot --out "$work/vot" >"$work/said" 2>&1
expect "export as vot" 0 $?
codes=$(grep -cx 2 "$work/vot/still/baseline/klahaag/klahaag_001.txt")
"$relock" import "$work/vot/still/baseline/klahaag/klahaag_001.txt" --as vot --sequence klahaag --method published \
  --out "$work/vot-back" >"$work/said" 2>&1
expect "import as vot" 0 $?
own=$("$relock" compatibility "$work/supervised" --eao 5 20 2>&1)
back=$("$relock" compatibility "$work/vot-back" --eao 5 20 2>&1)
expect "vot: failures are those of the file" "$codes" "$(awk '$1 == "still" {print $4; exit}' <<<"$own")"
expect "vot: the same scores" "$(row_of still "$own" | head -n 1)" \
  "$(row_of published "$back" | head -n 1 | sed 's/^published/still/')"

# Between a failure and the next start nothing was asked, so nothing was missed.
verdicts_of() { cut -d , -f 1-3 "$1/klahaag/recorded-vot/$2/verdicts.csv"; }  # RESULTS METHOD
"$relock" run --sequence klahaag --methods linear --protocol vot --out "$work/linear" >"$work/said" 2>&1
"$relock" export "$work/linear" --as vot --out "$work/linear-vot" >"$work/said" 2>&1
file=$work/linear-vot/linear/baseline/klahaag/klahaag_001.txt
"$relock" import "$file" --as vot --sequence klahaag --method published --out "$work/linear-back" >"$work/said" 2>&1
expect "linear: import as vot" 0 $?
"$relock" score "$work/linear" >"$work/said" 2>&1
"$relock" score "$work/linear-back" >"$work/said" 2>&1
expect "linear fails" yes "$([[ $(grep -cx 2 "$file") -gt 0 ]] && echo yes)"
expect "vot: verdicts differ on failures only" "$(awk '$0 == "2" { print NR - 1 }' "$file")" \
  "$(diff <(verdicts_of "$work/linear" linear) <(verdicts_of "$work/linear-back" published) | awk -F '[ ,]' '/^>/ { print $2 }')"
awk 'failed && $0 == "0" { $0 = "1,1,9,9"; failed = 0 } $0 == "2" { failed = 1 } { print }' "$file" >"$work/goes-on.txt"
said=$("$relock" import "$work/goes-on.txt" --as vot --sequence klahaag --method x --out "$work/none" 2>&1)
expect_contains "a region after a failure" "a region between a failure (2) and the next start (1)" "$said"

# Protocol multistart: one table over all starts.
"$relock" run --sequence klahaag --methods template --protocol multistart --out "$work/starts" >"$work/said" 2>&1
expect "run from many starts" 0 $?
starts=$("$relock" compatibility "$work/starts" --eao 5 20 2>&1)
expect "multistart: compatibility" 0 $?
expect_contains "multistart: its rules" "VOT (toolkit 0.8.0, multi-start; threshold" "$starts"
expect "multistart: one table has template" 1 "$(row_of template "$starts" | wc -l)"
# 53 and 51 frames; the toolkit takes the anchors' own for empty.
expect "multistart: two starts of a perfect method" "oracle 2 0.9808 0 1.0000 1.0000" "$(row_of oracle "$starts")"
expect "multistart: both starts of a mute one fail" "2 2" "$(awk '$1 == "mute" { print $2, $4 }' <<<"$starts")"
expect "multistart: scores are shares" 5 \
  "$(awk 'NF == 6 && $2 == 2 && $3 >= 0 && $3 <= 1 && $5 >= 0 && $5 <= 1 && $6 >= 0 && $6 <= 1' <<<"$starts" | wc -l)"

# What cannot be.
said=$("$relock" export "$work/results" --as vot --out "$work/none" 2>&1)
expect "a run of protocol once as vot: exit status" 2 $?
expect_contains "a run of protocol once as vot" "it is for runs of protocol vot" "$said"
said=$("$relock" export "$work/results" --as votr --out "$work/none" 2>&1)
expect_contains "an unknown format" 'did you mean "vot"' "$said"
said=$("$relock" export "$work/results" --as otb --out "$work/otb" 2>&1)
expect_contains "a folder that is there" "is there already" "$said"
head -n 50 "$work/otb/template/klahaag.txt" >"$work/short.txt"
said=$("$relock" import "$work/short.txt" --as otb --sequence klahaag --method x --out "$work/none" 2>&1)
expect "too few lines: exit status" 2 $?
expect_contains "too few lines" "there are 50 lines for the 53 pictures of klahaag" "$said"
sed '7s/.*/1,2,3/' "$work/otb/template/klahaag.txt" >"$work/three.txt"
said=$("$relock" import "$work/three.txt" --as otb --sequence klahaag --method x --out "$work/none" 2>&1)
expect_contains "three numbers" "three.txt:7: a box is x, y, width, height; there are 3" "$said"
sed '7s/.*/nan,1,2/' "$work/otb/template/klahaag.txt" >"$work/three.txt"
said=$("$relock" import "$work/three.txt" --as otb --sequence klahaag --method x --out "$work/none" 2>&1)
expect_contains "three of them, and one is none" "three.txt:7: a box is x, y, width, height; there are 3" "$said"
run=$work/results/klahaag/recorded-once/template
before=$(cksum "$run"/*)
said=$("$relock" import "$work/otb/template/klahaag.txt" --as otb --sequence klahaag --method template --out "$work/results" 2>&1)
expect "in the place of a run: exit status" 2 $?
expect_contains "in the place of a run" "holds a run that was made here, not imported; choose another --out" "$said"
expect "the run is what it was" "$before" "$(cksum "$run"/*)"
"$relock" import "$work/otb/template/klahaag.txt" --as otb --sequence klahaag --method template --out "$work/otb-back" >"$work/said" 2>&1
expect "in the place of an imported run" 0 $?
for name in oracle "still "; do
  said=$("$relock" import "$work/otb/template/klahaag.txt" --as otb --sequence klahaag --method "$name" --out "$work/none" 2>&1)
  expect "\"$name\": exit status" 2 $?
  expect_contains "the name of a yardstick" "is a yardstick, which relock computes itself; choose another --method" "$said"
done
said=$("$relock" import "$work/otb/template/klahaag.txt" --as otb --sequence klahaag-prints --method x --out "$work/none" 2>&1)
expect_contains "one file for three targets" "name theirs with --target" "$said"
said=$("$relock" import "$work/tum/template/klahaag.txt" --as tum --sequence klahaag --method x --out "$work/none" 2>&1)
expect_contains "a path has no boxes" "cannot be imported" "$said"
said=$("$relock" compatibility "$work/results" --eao 300 100 2>&1)
expect_contains "a range that is none" "no range of lengths" "$said"
finish
