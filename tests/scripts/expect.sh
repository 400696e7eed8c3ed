# shellcheck shell=bash
# The smallest test framework: expectations that are counted. To be sourced.

expectations_met=0 expectations_missed=0

expect() {  # WHAT EXPECTED GOT
  if [[ $2 == "$3" ]]; then
    ((++expectations_met))
  else
    ((++expectations_missed))
    printf '%s: %s: expected "%s", got "%s"\n' "$(basename "$0")" "$1" "$2" "$3"
  fi
}

expect_contains() {  # WHAT PART WHOLE
  if [[ $3 == *"$2"* ]]; then expect "$1" "$2" "$2"; else expect "$1" "…$2…" "$3"; fi
}

finish() {
  echo "$expectations_met passed, $expectations_missed failed"
  ((expectations_missed == 0))
}
