#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh DEB...: installs each Debian package in a clean Debian 12 (mmdebstrap's minbase) of its architecture and runs the
# program there; another architecture runs under QEMU. Exit 0 when all is as it should be. `./dev test package` builds the
# packages and runs it.
#
# In each: without what is only recommended (`--version`, `doctor`, a capture of the simulated aquarium, the line about what
# is missing). With the machine's own architecture also as apt installs it unless told otherwise (a video of a drawing), and
# then removed again. Nothing is left behind: the root folder is thrown away. Needs root's rights or user namespaces.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
SECONDS=0
say() { printf 'package: [%3d s] %s\n' "$SECONDS" "$*"; }
fail() {
  echo "package: FAILED: $*" >&2
  exit 1
}

# Where this machine itself gets a suite from, whatever mirror that is.
mirror() { apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' | awk -v suite="$1" '$2 == suite { print $1; exit }'; }

# can_run ARCH: here, or by an emulator that the kernel starts.
can_run() {
  [[ $1 == "$(dpkg --print-architecture)" ]] && return
  local name=qemu-aarch64
  [[ $1 == armhf ]] && name=qemu-arm
  [[ -e /proc/sys/fs/binfmt_misc/$name ]] && return
  mountpoint -q /proc/sys/fs/binfmt_misc || mount -t binfmt_misc none /proc/sys/fs/binfmt_misc || return
  [[ -e /proc/sys/fs/binfmt_misc/$name ]] || update-binfmts --enable "$name"
}

# in_clean_debian DEB ARCH SCRIPT: SCRIPT runs in the root folder, where the package is /package.deb.
in_clean_debian() {
  local deb=$1 arch=$2 script=$3
  local main="deb $(mirror bookworm) bookworm main" security="deb $(mirror bookworm-security) bookworm-security main"
  apt-config dump Acquire >"$work/apt.conf"  # proxies and the like
  # The security suite of a port is at times out of step with its own index: then the point release alone.
  local suites=("$main" "$security")
  [[ $arch == "$(dpkg --print-architecture)" ]] || suites=("$main")
  mmdebstrap --quiet --variant=minbase --arch="$arch" --format=null --aptopt="$work/apt.conf" \
    --customize-hook="copy-in '$here/$script' /" --customize-hook="upload '$deb' /package.deb" \
    --customize-hook="chroot \"\$1\" bash '/$script'" bookworm - "${suites[@]}"
}

for deb in "$@"; do
  arch=$(dpkg-deb --field "$deb" Architecture)
  can_run "$arch" || fail "nothing here runs programs for $arch; install qemu-user-static and binfmt-support"
  say "$(basename "$deb") in a clean Debian 12 without recommended packages"
  in_clean_debian "$deb" "$arch" small.sh || fail "$deb without recommended packages"
  [[ $arch == "$(dpkg --print-architecture)" ]] || continue
  say "$(basename "$deb") as apt installs it"
  in_clean_debian "$deb" "$arch" whole.sh || fail "$deb with recommended packages"
done
say "all as it should be"
