#!/usr/bin/env bash
# The Debian package has what it should, and nothing that it should not.
# Usage: deb_test.sh BUILD
set -uo pipefail
source tests/scripts/expect.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v dpkg-shlibdeps >/dev/null || { echo "dpkg-dev is not installed"; exit 77; }
(cd "$1" && cpack -G DEB -B "$work") >"$work/said" 2>&1
expect "it is packed" 0 $?
package=$(echo "$work"/relock_*_*.deb)
information=$(dpkg-deb --info "$package")
expect_contains "it is called relock" "Package: relock" "$information"
expect_contains "it depends on the OpenCV that it was built with" "libopencv-core" "$information"
expect_contains "it recommends what draws plots" "Recommends: gnuplot-nox" "$information"
expect_contains "it says what it is" "scores trackers and detectors" "$information"
contents=$(dpkg-deb --contents "$package")
for file in bin/relock lib/cmake/relock/relockConfig.cmake include/relock/core/plugin.h lib/librelock_eval.a \
  share/relock/recordings/klahaag/labels.csv share/relock/recordings/klahaag/LICENSE.txt share/doc/relock/copyright; do
  expect_contains "it has $file" "./usr/$file" "$contents"
done
expect "no sources" "" "$(grep '\.cpp$' <<<"$contents")"
dpkg-deb --extract "$package" "$work/root"
expect_contains "its program finds its recordings" "klahaag" \
  "$(cd / && "$work/root/usr/bin/relock" run --sequence klahaag --methods still --out "$work/out" 2>&1)"
finish
