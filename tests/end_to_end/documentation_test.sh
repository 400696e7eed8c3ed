#!/usr/bin/env bash
# Every command in README.md and docs/ does what the page shows.
# Usage: documentation_test.sh RELOCK      from the project's root
set -uo pipefail
exec perl scripts/check-documentation "$1" README.md docs/*.md
