# SPDX-License-Identifier: Apache-2.0
# Sourced by the guest's scripts: the program, and checks that say what went wrong.
mkdir -p /run/lib && cp /mnt/neontetra /mnt/*.so /run/lib/  # a run path of its own: not that of the machine it was built on
# Results go to memory first: a write to the host's folder waits for the host, and a camera does not.
mkdir -p /run/seen
cd /run/seen
trap 'cp -r /run/seen/. /mnt/' EXIT
neontetra() { LD_LIBRARY_PATH=/run/lib /run/lib/neontetra "$@"; }
fail() {
  echo "FAILED: $*"
  exit 1
}
# says FILE TEXT: the file has this text.
says() {
  grep -qF -- "$2" "$1" || { cat "$1"; fail "'$2' is not said in $1"; }
}
# rows FILE LEAST: so many rows below the head.
rows() {
  local count
  count=$(($(wc -l <"$1") - 1))
  ((count >= $2)) || fail "$1 has $count rows, $2 are too few"
}
# films FILE [TEXT]: waits until the program that writes its messages there has a picture, which is when it says TEXT.
films() {
  for _ in $(seq 300); do
    grep -qsF -- "${2:-frames a second}" "$1" && break
    sleep 0.1
  done
  sleep 1
}
