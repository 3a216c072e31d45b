# SPDX-License-Identifier: Apache-2.0
# Sourced: start_usb_camera plugs the simulated USB camera in, as $camera; for_libcamera lets libcamera see it.
start_usb_camera() {
  echo -1 >/sys/module/usbcore/parameters/autosuspend
  mkdir -p /dev/gadget
  mount -t gadgetfs gadget /dev/gadget || fail "no gadgetfs"
  cp /mnt/small/clip.yuyv /mnt/usb_camera /run/
  /run/usb_camera 480 272 5 /run/clip.yuyv &
  camera=$!
  for _ in $(seq 100); do [[ -e /dev/video0 ]] && break || sleep 0.1; done
  [[ -e /dev/video0 ]] || fail "uvcvideo does not see the camera"
}
# libcamera names a camera after the first parent device that firmware describes; dummy_hcd has none, so /sys gets one. It
# finds devices through udev.
for_libcamera() {
  local folder
  mkdir -p /run/sys
  mount -t tmpfs sys /run/sys
  for folder in /sys/*; do mkdir "/run/sys/${folder#/sys/}" && mount -o bind "$folder" "/run/sys/${folder#/sys/}"; done
  mkdir /run/sys/firmware_node
  echo '\_SB.SIM0' >/run/sys/firmware_node/path
  mount -o rbind /run/sys /sys
  /lib/systemd/systemd-udevd --daemon 2>/dev/null
  udevadm trigger --subsystem-match=video4linux --subsystem-match=media
  udevadm settle -t 20
}
