# SPDX-License-Identifier: Apache-2.0
# Runs inside the clean root: the package with what it recommends; then it goes, and nothing of it stays.
set -eu
fail() {
  echo "FAILED: $*"
  exit 1
}
cd "$(mktemp -d)"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
apt-get install -y -qq --no-install-recommends /package.deb >apt.txt 2>&1 || { tail -40 apt.txt; fail "apt-get install"; }
# What the program itself advises where these are missing.
apt-get install -y -qq --fix-policy --install-recommends >apt.txt 2>&1 || { tail -40 apt.txt; fail "--fix-policy"; }
neontetra doctor || fail "doctor"
for module in /usr/lib/neontetra/*.so; do
  if ldd "$module" | grep "not found"; then fail "$module lacks a library"; fi
done
neontetra animate --camera sim:scene=ghost,frames=40 --background vibe --character /usr/share/neontetra/characters/carp.png --out swim.mp4 || fail "animate"
[ "$(stat -c %s swim.mp4)" -gt 10000 ] || fail "the video is too small"
for file in man/man1/neontetra.1.gz bash-completion/completions/neontetra zsh/vendor-completions/_neontetra \
  fish/vendor_completions.d/neontetra.fish applications/neontetra.desktop icons/hicolor/scalable/apps/neontetra.svg \
  doc/neontetra/copyright; do
  [ -s "/usr/share/$file" ] || fail "/usr/share/$file is not there"
done
[ -s /usr/lib/systemd/system/neontetra-kiosk.service ] || fail "no service"
apt-get install -y -qq --no-install-recommends systemd >apt.txt 2>&1 || { tail -40 apt.txt; fail "systemd"; }
systemd-analyze verify --man=no neontetra-kiosk.service || fail "systemd-analyze finds fault with the service"
apt-get purge -y -qq neontetra >/dev/null 2>&1 || fail "apt-get purge"
left=$(find /usr /etc /var/lib -path '*neontetra*' -not -path '/var/lib/apt/*')
[ -z "$left" ] || fail "left behind: $left"
