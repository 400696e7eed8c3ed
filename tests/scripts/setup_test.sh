#!/usr/bin/env bash
# Tests scripts/setup with a fake package manager, so that nothing is installed.
# Usage: tests/scripts/setup_test.sh
set -euo pipefail
setup=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/scripts/setup
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

world=$(mktemp -d)
trap 'rm -r "$world"' EXIT
mkdir "$world/bin"
for tool in bash awk env dirname; do ln -s "$(command -v "$tool")" "$world/bin/$tool"; done

fake() {  # NAME, its script from standard input
  { echo "#!$BASH"; cat; } >"$world/bin/$1"
  chmod +x "$world/bin/$1"
}

# The fake machine: $world/installed lists its packages, $world/calls what was asked of apt-get,
# $world/user who is at work; apt-get fails while $world/offline exists, and needs an update first where
# $world/outdated exists.
fake dpkg-query <<'FAKE'
while [[ $1 == --* ]]; do shift; done
for package; do
  if grep -qx "$package" "$WORLD/installed"; then echo "installed $package"; else echo "unknown $package" >&2; fi
done
FAKE
fake apt-get <<'FAKE'
while [[ $1 != install && $1 != update ]]; do shift; done
echo "$1 as $(cat "$WORLD/user")" >>"$WORLD/calls"
[[ ! -e $WORLD/offline ]] || exit 100
if [[ $1 == update ]]; then rm -f "$WORLD/outdated"; exit; fi
[[ ! -e $WORLD/outdated ]] || exit 100
shift
for package; do [[ $package == --* ]] || echo "$package" >>"$WORLD/installed"; done
FAKE
fake id <<'FAKE'
[[ $(cat "$WORLD/user") == root ]] && echo 0 || echo 1000
FAKE
ln -s "$(command -v grep)" "$(command -v cat)" "$(command -v rm)" "$world/bin/"

machine() {  # USER
  rm -f "$world"/{installed,calls,offline,outdated,bin/sudo}
  touch "$world"/{installed,calls}
  echo "$1" >"$world/user"
}
sudo_that() {  # works|refuses
  fake sudo <<FAKE
[[ $1 == works ]] || exit 1
[[ \$1 != -n ]] || shift
echo root >"\$WORLD/user"
"\$@"
status=\$?
echo somebody >"\$WORLD/user"
exit \$status
FAKE
}
run() {
  status=0
  said=$(env -i PATH="$world/bin" WORLD="$world" "$setup" "$@" 2>&1 </dev/null) || status=$?
}
calls() { paste -sd, "$world/calls"; }
gives_up_in_one_sentence() {  # what the sentence must contain
  expect "$1: exit code" 2 "$status"
  expect "$1: lines said" 1 "$(grep -v '^relock: installing' <<<"$said" | grep -c .)"
  expect_contains "$1: names the command" "apt-get install --no-install-recommends g++" "$said"
}

machine root
run
expect "root: installs" 0 "$status"
expect "root: with one call" "install as root" "$(calls)"
expect "root: the compiler came" 1 "$(grep -cx 'g++' "$world/installed")"
expect "root: no package of another group came" 0 "$(grep -cx clang "$world/installed" || true)"
run
expect "second run: is silent" "" "$said"
expect "second run: asks nothing of apt-get" "install as root" "$(calls)"
run build test
expect_contains "another group: installs what is new" clang "$(cat "$world/installed")"
expect "another group: and nothing twice" "" "$(sort "$world/installed" | uniq -d)"

machine root
touch "$world/outdated"
run
expect "outdated lists: updates and tries again" "install as root,update as root,install as root" "$(calls)"
expect "outdated lists: installs" 0 "$status"

machine somebody
sudo_that works
run
expect "sudo: installs" 0 "$status"
expect "sudo: as root" "install as root" "$(calls)"

machine somebody
sudo_that refuses
run
gives_up_in_one_sentence "sudo refuses"
expect "sudo refuses: apt-get is not called" "" "$(calls)"

machine somebody
run
gives_up_in_one_sentence "no sudo"
expect "no sudo: apt-get is not called" "" "$(calls)"

machine root
touch "$world/offline"
run
gives_up_in_one_sentence "apt-get fails"

machine root
run nonsense
expect "unknown group: exit code" 2 "$status"

machine root
rm "$world/bin/dpkg-query"
run
expect "no Debian: exit code" 2 "$status"
expect "no Debian: apt-get is not called" "" "$(calls)"

finish
