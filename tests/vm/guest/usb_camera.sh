# SPDX-License-Identifier: Apache-2.0
# Sourced: start_usb_camera plugs the simulated USB camera in, as $camera, which writes what it is told to camera.txt; falls_silent
# films it and lets it fall silent; for_libcamera lets libcamera see it.
start_usb_camera() {
  echo -1 >/sys/module/usbcore/parameters/autosuspend
  mkdir -p /dev/gadget
  mount -t gadgetfs gadget /dev/gadget || fail "no gadgetfs"
  cp /mnt/small/clip.yuyv /mnt/usb_camera /run/
  /run/usb_camera 480 272 5 /run/clip.yuyv >camera.txt &
  camera=$!
  for _ in $(seq 100); do [[ -e /dev/video0 ]] && break || sleep 0.1; done
  [[ -e /dev/video0 ]] || fail "uvcvideo does not see the camera"
}
# falls_silent CAMERA TEXT: the program says TEXT when it has a picture. Silent once: it is started again and goes on; a camera that
# is silent for good ends with 3 and says what to look at.
falls_silent() {
  neontetra capture --background vibe --camera "$1" --frames 40 --frame-hashes silent.hashes 2>silent.txt &
  local film=$!
  films silent.txt "$2"
  kill -USR1 $camera
  wait $film || { cat silent.txt; fail "a camera that falls silent ends the capture"; }
  says silent.txt "; starting the camera again"
  rows silent.hashes 40
  neontetra capture --background vibe --camera "$1" 2>dead.txt &
  film=$!
  films dead.txt "$2"
  kill -USR2 $camera
  wait $film
  [[ $? == 3 ]] || { cat dead.txt; fail "a camera that is silent for good does not end with 3"; }
  says dead.txt "though the camera was started again; check "
  kill -USR1 $camera
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
