# SPDX-License-Identifier: Apache-2.0
# Every format of vivid; a camera in use; one that is unplugged and comes back. vivid drops frames under emulation: counts
# are of what came.
. /mnt/check.sh
neontetra --list-cameras >list.txt || fail "--list-cameras"
says list.txt "vivid [v4l2:/dev/video0]"
says list.txt "yuyv: 320x180"
neontetra doctor --json >doctor.json 2>doctor.err || { cat doctor.err; fail "doctor"; }
says doctor.json "NEON"
says doctor.json '"camera": "v4l2:/dev/video0"'
watch=(capture --background vibe)
for format in yuyv nv12 grey; do
  neontetra "${watch[@]}" --camera "v4l2:/dev/video0,size=320x180,fps=15,format=$format" --frames 30 --frame-hashes "$format.hashes" 2>"$format.txt" ||
    { cat "$format.txt"; fail "$format"; }
  rows "$format.hashes" 30
  says "$format.txt" "320x180 $format at 15 frames a second"
done
neontetra "${watch[@]}" --camera v4l2:/dev/video0,size=333x222 --frames 1 2>size.txt
[[ $? == 3 ]] || fail "a size that is not there does not end with 3"
says size.txt "has no 333x222; it offers"

camera=v4l2:/dev/video0,size=320x180,fps=10,wait=20
v4l2-ctl -d0 --stream-mmap=3 --stream-to=/run/held >/dev/null 2>&1 &
holder=$!
for _ in $(seq 300); do [[ -s /run/held ]] && break; sleep 0.1; done
neontetra "${watch[@]}" --camera $camera --frames 1 2>busy.txt
[[ $? == 3 ]] || fail "a camera in use does not end with 3"
says busy.txt "another program has the camera"
kill $holder
wait $holder

# Ten seconds of film, so that even a busy host pulls the plug in its middle.
neontetra "${watch[@]}" --camera $camera --frames 100 --frame-hashes unplugged.hashes --take unplugged.take 2>unplugged.txt &
film=$!
films unplugged.txt
v4l2-ctl -d0 -c disconnect=1
wait $film || { cat unplugged.txt; fail "unplugged and plugged in again"; }
says unplugged.txt "the camera was unplugged; plug it in again within 20 s"
says unplugged.txt "the camera is back"
rows unplugged.hashes 100
