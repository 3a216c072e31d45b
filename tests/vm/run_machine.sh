#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run_machine.sh FOLDER SHARE SCRIPT: boots the machine of make_machine.sh, runs SCRIPT (a file in SHARE, which is the
# machine's /mnt, writable) with bash, switches off and exits with SCRIPT's exit status; 125 and 126 where the machine failed.
# Emulated throughout (no KVM for arm64). Environment: VM_MODULES (to load; `name:option=value:...`), VM_TIMEOUT_S, VM_MONITOR (a
# socket of QEMU's; then the machine has a screen, too), VM_STEADY: one processor whose time goes by with its instructions, 2 ns
# each, so that a busy host makes the machine slow, not its camera drop frames. VM_SYSTEMD: systemd is the first process (boot_systemd.sh).
set -euo pipefail
folder=$1 share=$2 script=$3
rm -f "$share/.status"
cat >"$share/.init" <<'INIT'
export PATH=/usr/sbin:/usr/bin:/sbin:/bin:/run/busybox HOME=/run XDG_RUNTIME_DIR=/run
busybox mkdir -p /run/busybox
busybox --install -s /run/busybox
. /mnt/.modules
[ ! -e /mnt/.systemd ] || . /mnt/boot_systemd.sh
bash "/mnt/$(cat /mnt/.script)" </dev/null
echo $? >/mnt/.status
sync
busybox poweroff -f
INIT
echo "$script" >"$share/.script"
for module in ${VM_MODULES:-}; do echo "modprobe ${module//:/ } || echo 'machine: no module ${module%%:*}'"; done >"$share/.modules"
processors=(-accel tcg,thread=multi,tb-size=256 -smp 2)
[[ -z ${VM_STEADY:-} ]] || processors=(-accel tcg,thread=single,tb-size=256 -icount shift=1 -smp 1)
rm -f "$share/.systemd"
[[ -z ${VM_SYSTEMD:-} ]] || touch "$share/.systemd"
screen=()
[[ -z ${VM_MONITOR:-} ]] || screen=(-device virtio-gpu-pci -qmp "unix:$VM_MONITOR,server=on,wait=off")
timeout "${VM_TIMEOUT_S:-300}" qemu-system-aarch64 -M virt,gic-version=3 -cpu cortex-a72 "${processors[@]}" \
  -m 1024 -nodefaults -vga none -display none -serial stdio -no-reboot \
  -kernel "$folder/kernel" -initrd "$folder/initrd" \
  -append "console=ttyAMA0 quiet loglevel=4 panic=-1 mitigations=off audit=0 random.trust_cpu=on" \
  -virtfs "local,path=$folder/root,mount_tag=root,security_model=none,readonly=on,multidevs=remap" \
  -virtfs "local,path=$share,mount_tag=share,security_model=none,multidevs=remap" "${screen[@]}" </dev/null ||
  { echo "machine: QEMU ended with $?" >&2; exit 125; }
[[ -f $share/.status ]] || { echo "machine: the guest left no exit status" >&2; exit 126; }
exit "$(cat "$share/.status")"
