# SPDX-License-Identifier: Apache-2.0
# A drawing on the machine's screen without a desktop, until the host has a screenshot (screen.shot) or two minutes have passed.
. /mnt/check.sh
# Not check.sh's function: signals are for the program, not for a shell around it.
LD_LIBRARY_PATH=/run/lib /run/lib/neontetra live --display kms --camera sim:scene=ghost,size=480x272,fps=1 --background vibe --work-size 480x272 \
  --character /mnt/carp.ntchar --layout beside 2>kms.txt &
program=$!
for _ in $(seq 1200); do
  [[ -e /mnt/screen.shot ]] && break
  kill -0 $program 2>/dev/null || { cat kms.txt; fail "live by KMS has ended"; }
  sleep 0.1
done
[[ -e /mnt/screen.shot ]] || { cat kms.txt; fail "the host sees no picture"; }
kill -TERM $program
wait $program
status=$?
[[ $status == 0 ]] || { cat kms.txt; fail "live by KMS ends with $status"; }
says kms.txt "display: SDL2 screen (KMS), "
cat kms.txt
