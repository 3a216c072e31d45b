# SPDX-License-Identifier: Apache-2.0
# Frames played into vivid's output come out of its input.
. /mnt/check.sh
v4l2-ctl -d0 -c loop_video=1,osd_text_mode=2
v4l2-ctl -d1 -x width=1280,height=720,pixelformat=YUYV
cp /mnt/large/clip.yuyv /run/
v4l2-ctl -d1 --stream-out-mmap=4 --stream-from=/run/clip.yuyv --stream-loop --stream-count=600 >/dev/null 2>&1 &
player=$!
sleep 1
neontetra capture --background vibe --work-size 1280x720 --camera v4l2:/dev/video0,size=1280x720,format=yuyv --frames 12 \
  --frame-hashes loopback.hashes 2>loopback.txt
status=$?
kill $player
cat loopback.txt
exit $status
