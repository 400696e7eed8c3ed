#!/usr/bin/env bash
# Installs relock into a folder of the test's own.
# Usage: install_test.sh BUILD STAGE
set -uo pipefail
source tests/scripts/expect.sh
rm -rf "$2"
cmake --install "$1" --prefix "$2" >/dev/null
expect "it is installed" 0 $?
expect "the program runs" "relock" "$("$2/bin/relock" --version | cut -d' ' -f1)"
expect "its recordings are beside it" yes "$([[ -s $2/share/relock/recordings/klahaag/labels.csv ]] && echo yes)"
expect "their licences too" yes "$([[ -s $2/share/relock/recordings/klahaag/LICENSE.txt ]] && echo yes)"
expect "what made them is not" "" "$(find "$2/share" -name '*.cpp')"
expect "headers are" yes "$([[ -s $2/include/relock/core/plugin.h ]] && echo yes)"
finish
