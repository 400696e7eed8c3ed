# shellcheck shell=bash
# For scripts that do one thing after another and tell at the end how each went. To be sourced.
#   step NAME COMMAND...   runs the command, remembers result, time and the tests it counted
#   closing                prints the table; fails if any step failed
#   tests_in BUILD [CTEST_OPTION...]   runs tests of a build directory, for a step

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

  # What the test runners say: ctest for all before it, GoogleTest, and our own shell tests.
  read -r ours bad <<<"$(awk '
    /tests passed, [0-9]+ tests failed out of/ { bad = $4; good = $NF - $4 }
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

tests_in() {  # BUILD_DIRECTORY [CTEST_OPTION...]
  local wrong=0
  ctest --test-dir "$@" --parallel "$(nproc)" --output-on-failure --no-tests=error || wrong=1
  # A process that runs many cases is one test for ctest.
  awk '
    /^\[  PASSED  \] [0-9]+ test/ { good = $4 }
    /^ *[0-9]+ FAILED TESTS?$/     { bad = $1 }
    /^Test (Passed|Failed)\.$/ {
      more_good += good > 0 && $2 == "Passed." ? good - 1 : good
      more_bad += bad > 0 ? bad - 1 : 0
      good = bad = 0
    }
    END { printf "Cases, beyond one for each process:\n%d passed, %d failed\n", more_good, more_bad }
  ' "$1/Testing/Temporary/LastTest.log"
  return $wrong
}
