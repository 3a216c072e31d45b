#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh: real camera drivers without a camera. Builds an arm64 machine and the program for it, boots it under QEMU and
# watches vivid and a simulated USB camera. Exit 0 when all is as it should be. `./dev test vm` runs it from the top folder.
#
# 1 vivid: every format gives frames; a camera in use and one that is unplugged give their lines; what was filmed is kept
# 2 vivid's loopback: the frames that are played into it come out with the same bytes
# 3 the USB camera: poses and bytes are those of the same clip read from files on this machine, through uvcvideo;
#   its exposure is locked and given back, it falls silent and is started again; pulled out while it films, the recording is kept
# 4 the same camera through libcamera
# 5 a drawing on the machine's screen without a desktop (KMS), proved by a screenshot: build/vm/screen.ppm
# 6 the package's kiosk service, started by systemd with the machine: its screen (build/vm/kiosk.ppm), its user, its restarts
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
machine=$root/build/vm
share=$machine/share
program=$root/build/sim/app/neontetra
SECONDS=0
quietly() { "$@" 2>"$machine/run.log" || { cat "$machine/run.log"; return 1; }; }
say() { printf 'vm: [%3d s] %s\n' "$SECONDS" "$*"; }

# For the machine: the program and its modules, the USB camera, the guest's scripts. Here: the same program, and the clips.
build() {
  cd "$root"
  cmake --preset sim >"$machine/configure.log" && cmake --build --preset sim --target neontetra tank_clip >"$machine/build.log" ||
    { cat "$machine"/{configure,build}.log; return 1; }
  cmake --preset pi64 >"$machine/configure.log" 2>&1 && cmake --build --preset pi64 >"$machine/build.log" 2>&1 ||
    { tail -40 "$machine"/{configure,build}.log; return 1; }
  rm -rf "$share" && mkdir -p "$share"
  cp build/pi64/app/neontetra build/pi64/app/*.so "$here"/guest/*.sh "$here/guest/kiosk.env" "$share/"
  aarch64-linux-gnu-strip "$share/neontetra" "$share"/*.so
  DESTDIR="$share/installed" cmake --install build/pi64 --prefix /usr --strip >"$machine/install.log" || { cat "$machine/install.log"; return 1; }
  aarch64-linux-gnu-g++ -O2 -std=c++20 -static -o "$share/usb_camera" "$here/usb_camera.cpp" -pthread
  # 1280x720 is a size that vivid's loopback takes; the small clip is one that an emulated machine keeps up with.
  build/sim/tests/vm/tank_clip calm 1280 720 4 "$share/large"
  build/sim/tests/vm/tank_clip ghost 480 272 50 "$share/small"
}

# What the program here makes of the clips' pictures.
expect() {
  quietly "$program" capture --camera "$share/large/pictures" --work-size 1280x720 --background vibe --frame-hashes "$share/large.hashes"
  quietly "$program" capture --camera "$share/small/pictures" --fps 5 --background vibe --repair off --csv "$share/small.csv" \
    --frame-hashes "$share/small.hashes"
  quietly "$program" character "$root/assets/characters/carp.png" --out "$share/carp.ntchar"
}

# expect_seen HASHES: the same of the small clip's frames that were seen: libcamera starts a camera before it takes requests, so
# it may miss the first ones.
expect_seen() {
  local n=0 place
  local -a pictures=("$share"/small/pictures/*) places
  read -ra places <<<"$(python3 "$here/compare.py" order "$share/small.hashes" "$1")"
  mkdir -p "$machine/late" && rm -f "$machine"/late/*
  for place in "${places[@]}"; do
    ln -s "${pictures[place]}" "$machine/late/$(printf %04d $n).pgm"
    n=$((n + 1))
  done
  quietly "$program" capture --camera "$machine/late" --fps 5 --background vibe --repair off --csv "$share/late.csv" \
    --frame-hashes "$share/late.hashes"
}

run() { "$here/run_machine.sh" "$machine" "$share" "$1"; }

# run_with_screen NAME SECONDS SCRIPT: until the screen shows the drawing (NAME.ppm), which the machine learns by NAME.shot.
run_with_screen() {
  rm -f "$machine/monitor" "$share/$1.shot"
  python3 "$here/screenshot.py" "$machine/monitor" "$machine/$1.ppm" "$share/$1.shot" "$2" &
  local screenshot=$!
  VM_MONITOR=$machine/monitor VM_MODULES="virtio-gpu" run "$3"
  wait $screenshot
}

mkdir -p "$machine"
say "the machine"
"$here/make_machine.sh" --once "$machine"
say "building the program for arm64"
build
say "what is expected"
expect
say "vivid"
VM_MODULES="vivid:n_devs=1:node_types=0x1:num_inputs=1:input_types=0" run vivid.sh
say "vivid's loopback"
VM_MODULES="vivid:n_devs=1:node_types=0x101:num_inputs=1:input_types=3:num_outputs=1:output_types=1" run loopback.sh
python3 "$here/compare.py" known "$share/large.hashes" "$share/loopback.hashes"
say "the simulated USB camera"
VM_STEADY=1 VM_MODULES="dummy_hcd gadgetfs uvcvideo" run usb.sh
python3 "$here/compare.py" same "$share/small.hashes" "$share/usb.hashes" "$share/small.csv" "$share/usb.csv"
python3 "$here/compare.py" known "$share/small.hashes" "$share/silent.hashes"
python3 "$here/compare.py" kept "$share/small.csv" "$share/pulled.csv"
say "the same camera through libcamera"
VM_STEADY=1 VM_MODULES="dummy_hcd gadgetfs uvcvideo" run libcamera.sh
expect_seen "$share/libcamera.hashes"
python3 "$here/compare.py" same "$share/late.hashes" "$share/libcamera.hashes" "$share/late.csv" "$share/libcamera.csv"
python3 "$here/compare.py" known "$share/small.hashes" "$share/silent.hashes"
expect_seen "$share/libcamera_pulled.hashes"
python3 "$here/compare.py" kept "$share/late.csv" "$share/libcamera_pulled.csv"
say "a drawing on its screen"
run_with_screen screen 120 kms.sh
say "the kiosk service"
VM_SYSTEMD=1 VM_TIMEOUT_S=900 run_with_screen kiosk 600 kiosk.sh || { cat "$share/kiosk.failed"; exit 1; }
cat "$share/kiosk.passed"
say "all as it should be"
