#!/usr/bin/env bash
# Every command in README.md and docs/, or in the pages that are named, does what the page shows.
# Usage: documentation_test.sh RELOCK [PAGE...]      from the project's root
set -uo pipefail
relock=$1
shift
(($#)) || set -- README.md docs/*.md
exec perl scripts/check-documentation "$relock" "$@"
