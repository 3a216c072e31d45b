#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_sysroot.sh [--once] ARCH FOLDER [PACKAGE...]: Debian 12 packages of another architecture, those of packages.txt beside this
# script and these, and all that they depend on, unpacked into FOLDER for a cross build (NEONTETRA_SYSROOT). Nothing is installed
# or configured, here or there, and nothing of them runs. --once: unless it is there already, made of the same.
#
# FOLDER/var/lib/dpkg/shlibs says which package each library came with, for dpkg-shlibdeps (`./dev package`).
# Needs root's rights or user namespaces (mmdebstrap). arm64: about a minute and 1.5 GB.
set -euo pipefail
self=$(realpath "${BASH_SOURCE[0]}")

# Where this machine itself gets a suite from, whatever mirror that is.
mirror() { apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' | awk -v suite="$1" '$2 == suite { print $1; exit }'; }

# Run by mmdebstrap with the new root as $1, while the packages are still there.
note_packages() {
  local root=$1 deb
  for deb in "$root"/var/cache/apt/archives/*.deb; do
    dpkg-deb --ctrl-tarfile "$deb" | tar x --to-stdout ./shlibs 2>/dev/null || true  # most have none
  done >"$root/var/lib/dpkg/shlibs"
}

unpack() {
  rm -rf "$folder"
  mmdebstrap --quiet --variant=extract --arch="$arch" --skip=check/qemu --include="$wanted" \
    --setup-hook='mkdir -p "$1"/usr/lib "$1"/usr/bin "$1"/usr/sbin; for d in lib bin sbin; do ln -s usr/$d "$1/$d"; done' \
    --extract-hook="bash '$self' --note \"\$1\"" bookworm "$folder" "$@"
}

# Absolute links would lead out of the folder; update-alternatives, which did not run, would have linked lapack and blas.
mend_links() {
  local link library file
  while IFS= read -r -d '' link; do
    ln -sfn "$(realpath -m -s --relative-to="$(dirname "$link")" "$folder$(readlink "$link")")" "$link"
  done < <(find "$folder" -type l -lname '/*' -print0)
  for library in lapack blas; do
    for file in "$folder"/usr/lib/*/$library/lib$library.so.3; do
      [[ -e $file ]] || continue
      ln -sfn "$library/lib$library.so.3" "$(dirname "$(dirname "$file")")/lib$library.so.3"
    done
  done
}

if [[ $1 == --note ]]; then
  note_packages "$2"
  exit
fi
once=
[[ $1 == --once ]] && once=yes && shift
arch=$1 folder=$(realpath -m "$2")
shift 2
list=$(dirname "$self")/packages.txt
stamp=$({ cat "$self" "$list" && echo "$arch" "$@"; } | sha256sum)
if [[ -n $once && $(cat "$folder/stamp" 2>/dev/null) == "$stamp" ]]; then exit; fi
wanted=$({ sed 's/#.*//' "$list" && echo "$@"; } | xargs | tr ' ' ,)
main="deb $(mirror bookworm) bookworm main"
security="deb $(mirror bookworm-security) bookworm-security main"
# The security suite of a port is at times out of step with its own index: then the point release alone.
unpack "$main" "$security" || { echo "sysroot: without the security suite" >&2 && unpack "$main"; }
mend_links
rm -rf "$folder"/usr/share/{doc/[!l]*,man,locale} "$folder"/var/cache/apt "$folder"/var/lib/apt
echo "$stamp" >"$folder/stamp"
