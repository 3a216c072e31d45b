#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_machine.sh [--once] FOLDER: an arm64 Debian 12 machine for QEMU, from Debian's packages: FOLDER/{root,kernel,initrd}.
#
# root is a plain folder that the machine mounts over 9p, so there is no image to pack; it is the sysroot of the cross build
# too (toolchains/make_sysroot.sh, preset pi64). Needs root's rights or user namespaces (mmdebstrap), cpio, kmod. About two minutes and 2 GB.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [[ $1 == --once ]]; then  # unless it is there already, made by the same files
  stamp=$(cat "$here"/{make_machine.sh,packages.txt,guest/init} "$here"/../../toolchains/{make_sysroot.sh,packages.txt} | sha256sum)
  [[ $(cat "$2/stamp" 2>/dev/null) == "$stamp" ]] && exit
  "$0" "$2" && echo "$stamp" >"$2/stamp"
  exit
fi
folder=$(realpath -m "${1:?make_machine.sh FOLDER}")
# The kernel modules that the machine may load; these, and what they depend on, are kept.
modules="virtio_pci 9pnet_virtio 9p vivid uvcvideo dummy_hcd gadgetfs virtio-gpu overlay"
boot_modules="virtio_pci 9pnet_virtio 9p"  # before there is a root file system
packages=$(sed 's/#.*//' "$here/packages.txt" | xargs)

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
# shellcheck disable=SC2086  # a list of words
"$here/../../toolchains/make_sysroot.sh" arm64 "$folder/root" $packages
cd "$folder/root"
mkdir -p dev proc sys tmp run mnt root
printf 'root:x:0:0:root:/root:/bin/sh\n' >etc/passwd
printf 'root:x:0:\nvideo:x:44:\ninput:x:104:\nrender:x:105:\n' >etc/group
release=$(ls lib/modules)
mv "boot/vmlinuz-$release" "$folder/kernel"
keep_modules
pack_initrd
echo "machine: $(du -sh "$folder/root" | cut -f1), kernel $release"
