# SPDX-License-Identifier: Apache-2.0
# The simulated USB camera through libcamera: its pictures, its exposure, its silence; then pulled out while it films.
. /mnt/check.sh
. /mnt/usb_camera.sh
start_usb_camera
for_libcamera
neontetra --list-cameras >libcamera_list.txt || fail "--list-cameras"
says libcamera_list.txt "[libcamera:"
watch=(capture --background vibe --repair off)
neontetra "${watch[@]}" --camera libcamera:,size=480x272,fps=5 --frames 50 --csv libcamera.csv --frame-hashes libcamera.hashes \
  2>libcamera.txt || { cat libcamera.txt; fail "the USB camera through libcamera"; }
says libcamera.txt "480x272 yuyv"
says libcamera.txt "through libcamera"
says libcamera.txt "exposure and white balance are locked"
says camera.txt "exposure mode 1"
falls_silent libcamera: "are locked"
grep -q "exposure mode 8" camera.txt && { cat camera.txt; fail "the exposure is given back when the camera is started again"; }

neontetra "${watch[@]}" --camera libcamera --csv libcamera_pulled.csv --frame-hashes libcamera_pulled.hashes 2>libcamera_pulled.txt &
film=$!
films libcamera_pulled.txt "are locked"
sleep 5
kill $camera
wait $film
status=$?
cat libcamera_pulled.txt
[[ $status == 3 ]] || fail "a camera that was pulled ends libcamera's capture with $status, not with 3"
says libcamera_pulled.txt "the camera was unplugged; plug it in and start again"
neontetra "${watch[@]}" --camera libcamera --frames 1 2>none.txt
[[ $? == 3 ]] || { cat none.txt; fail "no camera does not end with 3"; }
says none.txt "libcamera sees none"
