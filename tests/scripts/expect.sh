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

# A mistake in what $relock is asked is one sentence and exit 2.
expect_mistake() {  # VERB WHAT SENTENCE ARGUMENT...
  local verb=$1 what=$2 sentence=$3 error
  shift 3
  error=$("$relock" "$verb" "$@" 2>&1 >/dev/null)
  expect "$what: exit status" 2 $?
  expect_contains "$what" "$sentence" "$error"
  expect "$what: one line" 1 "$(wc -l <<<"$error")"
}

finish() {
  echo "$expectations_met passed, $expectations_missed failed"
  ((expectations_missed == 0))
}
