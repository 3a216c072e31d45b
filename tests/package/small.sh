# SPDX-License-Identifier: Apache-2.0
# Runs inside the clean root: the package with what it depends on alone.
set -eu
fail() {
  echo "FAILED: $*"
  exit 1
}
cd "$(mktemp -d)"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
apt-get install -y -qq --no-install-recommends /package.deb >apt.txt 2>&1 || { cat apt.txt; fail "apt-get install"; }
neontetra --version
neontetra doctor || fail "doctor"
neontetra doctor --json >doctor.json 2>/dev/null || fail "doctor --json"
case $(dpkg --print-architecture) in
  amd64) simd=SSSE3 ;;
  *) simd=NEON ;;
esac
grep -A 3 '"simd"' doctor.json | grep -q "\"$simd\"" || fail "doctor: not built for $simd"
neontetra capture --camera sim:scene=ghost,frames=60 --background vibe --csv fish.csv || fail "capture"
rows=$(($(wc -l <fish.csv) - 1)) poses=$(grep -c ',ok,' fish.csv)
[ "$rows" = 60 ] && [ "$poses" -gt 30 ] || fail "capture: $rows rows, $poses poses"
echo "capture: $rows rows, $poses poses"
# What is missing is said, with what to do.
if neontetra capture --camera file:/etc/hostname --csv x.csv 2>missing.txt; then fail "a video without the libraries"; fi
cat missing.txt
grep -q "apt-get install --fix-policy --install-recommends" missing.txt || fail "no advice on what is missing"
neontetra --list-cameras
if ldd /usr/bin/neontetra /usr/lib/neontetra/libneontetra_display.so /usr/lib/neontetra/libneontetra_panel.so /usr/lib/neontetra/libneontetra_jpeg.so |
  grep "not found"; then fail "a library is missing that the package does not depend on"; fi
