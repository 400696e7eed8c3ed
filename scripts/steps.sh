# shellcheck shell=bash
# For scripts that do one thing after another and tell at the end how each went. To be sourced.
#   step NAME COMMAND...   runs the command, remembers result, time and the tests it counted
#   closing                prints the table; fails if any step failed

names=() results=() seconds=() counts=()
first_failure=""
passed=0 failed=0

# shellcheck disable=SC2034  # the arrays are read in `closing`
step() {
  local name=$1 start=$SECONDS said result=ok ours=0 bad=0
  shift
  echo "== $name"
  said=$(mktemp)
  "$@" 2>&1 | tee "$said" || result=FAILED

  # What the test runners say: ctest, GoogleTest, and our own shell tests.
  read -r ours bad <<<"$(awk '
    /tests passed, [0-9]+ tests failed out of/ { bad = $4; good = $NF - $4; exit }
    /^\[  PASSED  \] [0-9]+ test/              { good += $4 }
    /^ *[0-9]+ FAILED TESTS?$/                 { bad += $1 }
    /^[0-9]+ passed, [0-9]+ failed$/           { good += $1; bad += $3 }
    END { print good + 0, bad + 0 }' "$said")"
  rm "$said"
  if ((ours + bad == 0)); then  # a step without counted tests is one check
    [[ $result == ok ]] && ours=1 || bad=1
  fi
  [[ $result == ok || $bad -gt 0 ]] || bad=1
  ((passed += ours, failed += bad, 1))

  [[ $result == ok ]] || first_failure=${first_failure:-$name}
  names+=("$name") results+=("$result") seconds+=($((SECONDS - start))) counts+=("$ours passed, $bad failed")
  [[ $result == ok ]]
}

closing() {
  local i
  echo
  for i in "${!names[@]}"; do
    printf '%-34s %5d s  %-6s  %s\n' "${names[i]}" "${seconds[i]}" "${results[i]}" "${counts[i]}"
  done
  [[ -z $first_failure ]] || echo "First to fail: $first_failure"
  echo "$passed passed, $failed failed"
  ((failed == 0))
}
