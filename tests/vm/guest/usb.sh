# SPDX-License-Identifier: Apache-2.0
# The simulated USB camera through uvcvideo: its pictures, its exposure, its silence; then pulled out while it films.
. /mnt/check.sh
. /mnt/usb_camera.sh
start_usb_camera
watch=(capture --background vibe --repair off)
neontetra "${watch[@]}" --camera v4l2:/dev/video0,lock=off --frames 50 --csv usb.csv --frame-hashes usb.hashes 2>usb.txt ||
  { cat usb.txt; fail "the USB camera"; }
says usb.txt "480x272 yuyv at 5 frames a second"
[[ ! -s camera.txt ]] || { cat camera.txt; fail "lock=off touches the camera's exposure"; }

neontetra "${watch[@]}" --camera v4l2:/dev/video0 --frames 2 2>locked.txt || { cat locked.txt; fail "locking the exposure"; }
says locked.txt "; locked: exposure"
[[ $(cut -d' ' -f3 <camera.txt) == $'1\n156\n8' ]] || { cat camera.txt; fail "exposure is not locked and given back"; }
falls_silent v4l2:/dev/video0,lock=off "frames a second"

neontetra "${watch[@]}" --camera v4l2:/dev/video0,lock=off,wait=1 --csv pulled.csv --take pulled.take 2>pulled.txt &
film=$!
films pulled.txt
sleep 5
kill $camera
wait $film
[[ $? == 3 ]] || { cat pulled.txt; fail "a camera that was pulled does not end with 3"; }
says pulled.txt "the camera was unplugged and did not come back within 1 s; plug it in and start again"
neontetra takes pulled.take >takes.txt || { cat takes.txt; fail "the take cannot be read"; }
cat takes.txt
