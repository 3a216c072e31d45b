# SPDX-License-Identifier: Apache-2.0
# Sourced by the machine's first process (busybox sh): the package as it is installed and a memory for what is written come over
# the root folder, and systemd takes over. It starts the kiosk as `systemctl enable` would have it, and /mnt/.script.
mkdir -p /run/over
mount -t tmpfs over /run/over
mkdir /run/over/upper /run/over/work /run/over/root
mount -t overlay -o lowerdir=/mnt/installed:/,upperdir=/run/over/upper,workdir=/run/over/work overlay /run/over/root
cd /run/over/root
units=etc/systemd/system
mkdir -p $units/multi-user.target.wants etc/default before
cat >$units/machine.service <<UNIT
[Service]
Type=oneshot
Environment=HOME=/run PATH=/usr/sbin:/usr/bin:/sbin:/bin
ExecStart=/bin/bash -c 'bash /mnt/\$(cat /mnt/.script); echo \$\$? >/mnt/.status; sync; /bin/busybox poweroff -f'
StandardOutput=file:/dev/ttyAMA0
StandardError=inherit
UNIT
ln -sf /$units/machine.service $units/multi-user.target.wants/
ln -sf /lib/systemd/system/neontetra-kiosk.service $units/multi-user.target.wants/
ln -sf /lib/systemd/system/multi-user.target $units/default.target
# The machine has no agetty: systemd would start one after the other in vain, which is half of what an emulated processor can do.
for unit in getty@ serial-getty@ getty-static; do ln -sf /dev/null $units/$unit.service; done
cp /mnt/kiosk.env etc/default/neontetra
: >etc/machine-id
for folder in dev proc sys mnt; do mount --move /$folder $folder; done
pivot_root . before
exec chroot . /lib/systemd/systemd --log-target=kmsg --show-status=no </dev/console >/dev/console 2>&1
