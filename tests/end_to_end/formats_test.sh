#!/usr/bin/env bash
# A recording of every format can be run and scored; one without labels says so.
# Usage: formats_test.sh RELOCK      from the project's root
set -uo pipefail
source tests/scripts/expect.sh
relock=$1
samples=tests/data/formats
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for sample in otb otb-two vot vot-2013 got10k uav123/data_seq/UAV123/bike1 uav123/anno/UAV123/car1_2.txt; do
  said=$("$relock" run --sequence $samples/$sample --methods still --out "$work/$sample" 2>&1)
  expect "$sample runs" 0 $?
  expect_contains "$sample is scored" "still" "$("$relock" score "$work/$sample" 2>&1)"
done
for sample in euroc tum; do
  said=$("$relock" run --sequence $samples/$sample --methods still --out "$work/$sample" 2>&1)
  expect "$sample without labels: exit status" 2 $?
  expect_contains "$sample without labels" "without truth nothing can be scored" "$said"
done
finish
