# SPDX-License-Identifier: Apache-2.0
# The kiosk as systemd starts it: on the screen, under a user of its own; one that hangs and one that dies are started again.
fail() {
  {
    echo "FAILED: $*"
    systemctl status neontetra-kiosk --no-pager | head -20
    systemctl list-jobs --no-pager
    journalctl --no-pager -o short-monotonic | tail -60
  } >/mnt/kiosk.failed
  exit 1
}
show() { systemctl show -P "$1" neontetra-kiosk; }
# runs: waits until it has said that it is ready, as another process than $pid.
runs() {
  local until=$((SECONDS + 120))
  until [[ $(show ActiveState) == active && $(show MainPID) != "$pid" ]]; do
    ((SECONDS < until)) || fail "$1"
    sleep 0.5
  done
  pid=$(show MainPID)
}
pid=0
runs "the kiosk does not start"
owner=$(stat -c %u "/proc/$pid")
# systemd.exec(5): what DynamicUser= takes a user from.
((owner >= 61184 && owner <= 65519)) || fail "its user is $owner"
for _ in $(seq 1800); do [[ -e /mnt/kiosk.shot ]] && break || sleep 0.1; done
[[ -e /mnt/kiosk.shot ]] || fail "the host sees no picture"
kill -KILL "$pid"
runs "a kiosk that was killed does not start again"
kill -STOP "$pid"
runs "a kiosk that hangs is not started again"
# Not by grep: the machine, where systemd is its first process, has none.
journal=$(journalctl --no-pager -o cat)
[[ $journal == *"neontetra-kiosk.service: Watchdog timeout"* ]] || fail "the watchdog has not barked"
[[ $journal == *"display: SDL2 screen (KMS), "* ]] || fail "its line about the screen is missing"
(($(show NRestarts) == 2)) || fail "restarted $(show NRestarts) times, not 2"
echo "vm: the kiosk runs as user $owner, and was started again after a kill and after it hung" >/mnt/kiosk.passed
