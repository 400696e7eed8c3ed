#!/usr/bin/env bash
# Combinations: the same bytes whatever the number of jobs and whenever they are interrupted, and what they gain.
# Usage: combinations_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

bytes_of() { (cd "$1" && find . -type f ! -name timing.csv ! -name .lock -print0 | sort -z | xargs -0 sha256sum); }
runs_in() { find "$1" -name run.json -not -path '*/.*' 2>/dev/null | wc -l; }

cp docs/combining-flight.toml "$work/flight.toml"
"$relock" simulate "$work/flight.toml" --duration 0.6 --seed 3 --out "$work/flight" >"$work/said"
expect "a flight is flown" 0 $?
cat >"$work/plan.toml" <<'END'
sequences = ["flight"]
methods = ["kcf", "gap-aware(kcf)", "blur-predict(kcf,ring)", "guarded(kcf,ring,every=3)", "hybrid(ring,kcf)",
           "blut", "gap-aware(blut)", "blur-predict(blut)", "hybrid(ring,blut)", "guarded(gap-aware(blut),ring,every=3)"]
gaps = ["bernoulli(0.4)"]
paired = true
END
plan() { "$relock" run "$work/plan.toml" "$@" >"$work/said" 2>&1; }

plan --out "$work/one" --jobs 1
expect "combinations run" 0 $?
expect "all of them, and the yardsticks, in both arms" 28 "$(runs_in "$work/one")"
plan --out "$work/two" --jobs 2
expect "two jobs give the same bytes" "$(bytes_of "$work/one")" "$(bytes_of "$work/two")"

"$relock" run "$work/plan.toml" --out "$work/stopped" --jobs 2 >/dev/null 2>&1 &
victim=$!
until [[ $(runs_in "$work/stopped") -ge 3 ]] || ! kill -0 $victim 2>/dev/null; do sleep 0.02; done
kill -9 $victim 2>/dev/null
wait $victim 2>/dev/null
expect "it was interrupted between runs" yes "$([[ $(runs_in "$work/stopped") -lt 28 ]] && echo yes)"
plan --out "$work/stopped"
expect "and finished" 0 $?
expect "interrupted and gone on with, they give the same bytes" "$(bytes_of "$work/one")" "$(bytes_of "$work/stopped")"

expect "the gain is the same, too" "$("$relock" gain "$work/one")" "$("$relock" gain "$work/stopped")"
table=$("$relock" gain "$work/one")
expect_contains "a row for each tracker" "  blut  without" "$table"
expect_contains "a column for each combination" "guarded(gap-aware(T),ring,every=3)" "$table"
expect "JSON has every method" 10 "$("$relock" gain "$work/one" --json | grep -c '"method"')"
expect_mistake gain "an unknown score" "locked-share, recognition, availability and losses" "$work/one" --score lost

"$relock" run --sequence klahaag --methods kcf --gaps 'bernoulli(0.2)' --paired --out "$work/alone" >/dev/null 2>&1
expect_mistake gain "trackers alone" "no combination there stands beside the tracker in it" "$work/alone"
finish
