#!/usr/bin/env bash
# Plug-ins built against an installed relock: good ones work, and each kind of bad one is one sentence.
# Usage: plugins_test.sh STAGE
set -uo pipefail
source tests/scripts/expect.sh
stage=$1
relock=$stage/bin/relock
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_DATA_HOME=$work/data
unset RELOCK_PLUGINS
clip=$stage/share/relock/recordings/klahaag
picture=$clip/images/00001.jpg

in_c() {  # FILE [OPTION...]
  cc -std=c11 -Wall -Wextra -pedantic -Werror -D_DEFAULT_SOURCE -fPIC -shared -I"$stage/include" tests/packaging/plugin.c -o "$@"
}
in_cpp() {  # FILE [OPTION...]
  c++ -std=c++20 -fPIC -shared -I"$stage/include/relock" tests/packaging/throws.cpp -o "$@"
}
left_out() {  # WHAT PART FILE: list goes on without it and says so in one sentence
  local said status
  said=$("$relock" list --plugin "$3" 2>&1 >"$work/list")
  status=$?
  expect "$1: exit status" 1 "$status"
  expect_contains "$1" "relock: plug-in $3 is left out: $2" "$said"
  expect "$1: one sentence" 1 "$(wc -l <<<"$said")"
  expect_contains "$1: the rest is there" "kcf " "$(cat "$work/list")"
}
bad() {  # WHAT PART [OPTION...]: plugin.c with these options
  local what=$1 part=$2
  shift 2
  in_c "$work/libbad.so" "$@" || expect "$what: compiles" 0 1
  left_out "$what" "$part" "$work/libbad.so"
}

# A good one, in C.
good=$work/libplain.so
in_c "$good"
expect "a plug-in in C compiles" 0 $?
listed=$("$relock" list --verbose --plugin "$good")
expect "it is listed" 0 $?
expect_contains "with its method and where that is from" "the whole picture (libplain.so)" "$listed"
expect_contains "and its options" "margin=0 px" "$listed"
expect_contains "it detects" "plain:1 at 319.50, 179.50" "$("$relock" detect "$picture" --method whole --plugin "$good")"
explain() { "$relock" detect "$picture" --method whole --explain --out "$work/explained" --plugin "$1" 2>&1; }
expect_contains "it shows its stages" "2 profile: it rises ($work/explained/2-profile.svg)" "$(explain "$good")"
expect "as files" "1-shades.png 2-profile.svg" "$(cd "$work/explained" && echo *)"
in_c "$work/libno.so" -DSTAGE=NULL
expect_contains "half a stage is told" "it shows a stage whose sentence is NULL" "$(explain "$work/libno.so")"
run() { "$relock" run --sequence "$clip" --out "$work/out" "$@" 2>&1; }
expect_contains "it tracks" "53 frames in" "$(run --methods stays,kcf --plugin "$good" | grep '^stays')"
verdicts() { cut -d, -f1-9 "$work/out/klahaag/recorded-once/$1/trajectory.csv"; }
expect "like the one built in that does the same" "$(verdicts still)" "$(verdicts stays)"
expect_contains "an option that it refuses is told in its words" "whole: a margin cannot be negative" \
  "$("$relock" detect "$picture" --method 'whole(margin=-1)' --plugin "$good" 2>&1)"
expect_contains "an option that it has not is told" 'has no option "margn" (did you mean "margin"?)' \
  "$("$relock" detect "$picture" --method 'whole(margn=1)' --plugin "$good" 2>&1)"

# Where plug-ins are looked for.
mkdir -p "$XDG_DATA_HOME/relock/plugins"
cp "$good" "$XDG_DATA_HOME/relock/plugins"
expect_contains "the user's folder is looked into" libplain.so "$("$relock" list)"
rm "$XDG_DATA_HOME/relock/plugins/libplain.so"
expect_contains "RELOCK_PLUGINS too" libplain.so "$(RELOCK_PLUGINS=$work/none.so:$good "$relock" list 2>/dev/null)"
expect "a fault there is no fault of the run" 0 "$(RELOCK_PLUGINS=$work/none.so "$relock" list >/dev/null 2>&1; echo $?)"
expect_contains "a folder stands for what is in it" libplain.so "$("$relock" list --plugin "$work")"
expect "one that is named twice is one" "" "$("$relock" list --plugin "$good" --plugin "$good" 2>&1 >/dev/null)"
mkdir "$work/empty"
left_out "a folder without any" "there is no shared library" "$work/empty"

# A run goes on without a plug-in at fault, unless it needs its method.
run --methods still --plugin "$work/none.so" >"$work/said"
expect "a run that does not need it goes on" 1 $?
expect_contains "to its end" "Results are in" "$(cat "$work/said")"
run --methods whole --plugin "$work/none.so" >"$work/said"
expect "one that needs it does not" 2 $?
expect_contains "and says so" 'no method is called "whole"' "$(cat "$work/said")"

# Files that are no plug-ins.
left_out "no file" "it does not exist" "$work/none.so"
echo hello >"$work/text.so"
left_out "no library" "it is no shared library" "$work/text.so"
head -c 3000 "$good" >"$work/cut.so"
left_out "half a library" "it " "$work/cut.so"
bad "no entry" "it is no relock plug-in: it has no function relock_plugin_v1" -DNO_ENTRY -Wno-unused
bad "a function that is nowhere" "it cannot be loaded (undefined symbol: missing_function)" -DMISSING
library() {  # NAME [OPTION...]: an empty library
  echo 'int nothing;' | cc -x c -shared -fPIC -Wl,-soname,"$1" -Wl,-rpath,"$work" -Wl,--no-as-needed -o "$work/$1" - -x none "${@:2}"
}
needs() { echo "-Wl,-rpath,$work -Wl,--no-as-needed $work/$1"; }
library libnowhere.so
# shellcheck disable=SC2046  # several options
in_c "$work/libbad.so" $(needs libnowhere.so)
rm "$work/libnowhere.so"
left_out "a library that is nowhere" "it cannot be loaded (libnowhere.so: cannot open" "$work/libbad.so"
library libopencv_core.so.999
library libmiddle.so "$work/libopencv_core.so.999"
# shellcheck disable=SC2046
bad "another OpenCV" "it was built against another OpenCV (libopencv_core.so.999) than this relock (libopencv_core.so." \
  $(needs libopencv_core.so.999)
# shellcheck disable=SC2046
bad "another OpenCV, by way of another library" "it was built against another OpenCV (libopencv_core.so.999)" $(needs libmiddle.so)

# Code that does not behave.
bad "a crash when it is loaded" "it does not survive being loaded: it was killed by signal 11" '-DAT_LOAD_DO=crash()'
bad "an abort" "it does not survive being loaded: it was killed by signal 6" '-DAT_ENTRY=abort()'
bad "leaving the program" "it does not survive being loaded: it left the program with status 0" '-DAT_LOAD_DO=exit(0)'
bad "a hang" "it does not survive being loaded: it gave no answer for 10 s" '-DAT_ENTRY=sleep(60)'
in_cpp "$work/libthrows.so" -DAT_LOAD
left_out "a throw when it is loaded" "it " "$work/libthrows.so"
in_cpp "$work/libthrows.so" -DAT_FILL -Wno-unused
left_out "a registration that throws" "it cannot serve here: there is no such camera" "$work/libthrows.so"

# Tables that lie.
bad "another version" "it speaks version 2 of the plug-in interface, not 1" -DABI=2
bad "another layout" "its structs are of 8, " -DTABLE_SIZE=8
bad "a plug-in without a name" "its name is missing (NULL)" -DNAME=NULL
bad "a method without a name" "the name of method 1 is missing (NULL)" -DMETHOD=NULL
bad "a name that cannot be typed" 'the name of method 1 is "a,b"; it must be of letters' '-DMETHOD="a,b"'
bad "two methods of one name" 'another method is called "whole" already' '-DSECOND="whole"'
bad "the name of one built in" 'another method is called "kcf" already' '-DMETHOD="kcf"'
bad "no list of methods" "its methods are 2 by count, but the list is NULL" -DMETHODS=NULL -Wno-unused
bad "an option without a name" "the name of option 1 of whole is missing (NULL)" -DOPTION=NULL
bad "an option listed twice" "whole lists option shade twice" '-DOPTION="shade"'
bad "more options than can be" "the options of whole are 4000000000 by count" -DOPTION_COUNT=4000000000
bad "more options than there are" "" -DOPTION_COUNT=900
bad "a method without its function" "whole has no function detect" -DDETECT=NULL -Wno-unused
in_c "$work/libtwin.so" '-DSECOND="own"'
said=$("$relock" list --plugin "$good" --plugin "$work/libtwin.so" 2>&1)
expect_contains "two plug-ins with one method: the first one has it" \
  "libtwin.so is left out: another method is called \"whole\" already" "$said"
expect "and nothing of the second is there" 0 "$(grep -c '^own ' <<<"$said")"

# Objects that do not behave.
in_c "$work/libplain.so" '-DAT_CREATE=crash()'
expect_contains "a crash when it is made" "whole of plug-in libplain.so cannot be made: it was killed by signal 11" \
  "$("$relock" detect "$picture" --method whole --plugin "$good" 2>&1)"
in_c "$work/libplain.so" '-DAT_CREATE=return NULL'
expect_contains "nothing is made" "whole makes nothing and does not say why" \
  "$("$relock" detect "$picture" --method whole --plugin "$good" 2>&1)"
in_c "$work/libplain.so" -DPLACES=2
expect_contains "two places for one target" "stays says of one target that it is in 2 places" "$(run --methods stays --plugin "$good")"
expect_contains "which a plug-in that has changed is run again to find" "53 frames" "$(in_c "$good" && run --methods stays --plugin "$good" | grep '^stays')"
expect_contains "one that has not is not" "kept" "$(run --methods stays --plugin "$good" | grep '^stays')"
in_c "$good" '-DAT_TRACK=crash()'
expect_contains "a crash in a run is a failure of the method" "signal 11" "$(run --methods stays --plugin "$good")"
in_cpp "$work/libthrows.so"
expect_contains "a throw in a run is a failure of the method" "throws had enough of it" "$(run --methods throws --plugin "$work/libthrows.so")"
expect_contains "an option out of range" 'option count is "77"; it must be a whole number from 0 to 9' \
  "$(run --methods 'throws(count=77)' --plugin "$work/libthrows.so")"
expect_contains "a throw that is no exception" "it threw something that is no exception" \
  "$(run --methods 'throws(count=9)' --plugin "$work/libthrows.so")"
finish
