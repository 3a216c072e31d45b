#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_machine.sh FOLDER: an arm64 Debian 12 machine for QEMU, from Debian's packages: FOLDER/{root,kernel,initrd}.
#
# root is a plain folder that the machine mounts over 9p, so there is no image to pack; it is the sysroot of the cross build
# too (toolchains/aarch64.cmake, NEONTETRA_SYSROOT). Packages are unpacked, never configured, so nothing of them runs here.
# Needs root's rights or user namespaces (mmdebstrap), cpio, kmod. About two minutes and 2 GB.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(realpath -m "${1:?make_machine.sh FOLDER}")
# The kernel modules that the machine may load; these, and what they depend on, are kept.
modules="virtio_pci 9pnet_virtio 9p vivid uvcvideo dummy_hcd gadgetfs virtio-gpu"
boot_modules="virtio_pci 9pnet_virtio 9p"  # before there is a root file system
packages=$(sed 's/#.*//' "$here/packages.txt" | xargs | tr ' ' ,)

# Where this machine itself gets a suite from, whatever mirror that is.
mirror() { apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' | awk -v suite="$1" '$2 == suite { print $1; exit }'; }

unpack() {
  rm -rf "$folder/root"
  mmdebstrap --quiet --variant=extract --arch=arm64 --skip=check/qemu --include="$packages" \
    --setup-hook='mkdir -p "$1"/usr/lib "$1"/usr/bin "$1"/usr/sbin; for d in lib bin sbin; do ln -s usr/$d "$1/$d"; done' \
    bookworm "$folder/root" "$@"
}

# Absolute links would lead out of the folder; update-alternatives, which did not run, would have linked lapack and blas.
mend_links() {
  local link library file
  while IFS= read -r -d '' link; do
    ln -sfn "$(realpath -m -s --relative-to="$(dirname "$link")" "$folder/root$(readlink "$link")")" "$link"
  done < <(find "$folder/root" -type l -lname '/*' -print0)
  for library in lapack blas; do
    for file in "$folder"/root/usr/lib/*/$library/lib$library.so.3; do
      ln -sfn "$library/lib$library.so.3" "$(dirname "$(dirname "$file")")/lib$library.so.3"
    done
  done
}

# dependencies MODULE...: their files in the order in which they are loaded.
dependencies() {
  local module
  for module in "$@"; do modprobe -d "$folder/root" -S "$release" --show-depends "$module" | awk '/^insmod/ { print $2 }'; done | awk '!seen[$0]++'
}

keep_modules() {
  local keep=$folder/keep file
  depmod -b "$folder/root" "$release"
  for file in $(dependencies $modules); do
    mkdir -p "$keep/$(dirname "${file#"$folder/root/"}")" && cp "$file" "$keep/${file#"$folder/root/"}"
  done
  cp "$folder/root/lib/modules/$release"/modules.{order,builtin,builtin.modinfo} "$keep/lib/modules/$release/"
  rm -rf "${folder:?}/root/lib/modules/$release"
  mv "$keep/lib/modules/$release" "$folder/root/lib/modules/"
  rm -rf "$keep"
  depmod -b "$folder/root" "$release"
}

pack_initrd() {
  local stage=$folder/stage number=10 file
  rm -rf "$stage" && mkdir -p "$stage"/{bin,modules,dev,proc,sys,root}
  cp "$folder/root/bin/busybox" "$stage/bin/"
  for file in $(dependencies $boot_modules); do
    cp "$file" "$stage/modules/$number-$(basename "$file")"
    number=$((number + 1))
  done
  cp "$here/guest/init" "$stage/init"
  (cd "$stage" && find . | cpio --quiet -o -H newc | gzip -1) >"$folder/initrd"
  rm -rf "$stage"
}

mkdir -p "$folder"
main="deb $(mirror bookworm) bookworm main"
security="deb $(mirror bookworm-security) bookworm-security main"
# The security suite of a port is at times out of step with its own index: then the point release alone.
unpack "$main" "$security" || unpack "$main"
cd "$folder/root"
mkdir -p dev proc sys tmp run mnt root
mend_links
rm -rf usr/share/{doc/[!l]*,man,locale} var/cache/apt var/lib/apt
printf 'root:x:0:0:root:/root:/bin/sh\n' >etc/passwd
printf 'root:x:0:\nvideo:x:44:\ninput:x:104:\nrender:x:105:\n' >etc/group
release=$(ls lib/modules)
mv "boot/vmlinuz-$release" "$folder/kernel"
keep_modules
pack_initrd
echo "machine: $(du -sh "$folder/root" | cut -f1), kernel $release"
