#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""screenshot.py SOCKET PICTURE.ppm DONE SECONDS: what the machine's screen shows, once it shows the drawing; then makes the file DONE.

Asks QEMU (QMP) every two seconds. The drawing is there when the right half has the carp's orange and the left half the
aquarium's picture: a black screen and one of a console have neither. Exit 1 after SECONDS without it.
"""
import json
import pathlib
import socket
import sys
import time


def connect(path):
    for _ in range(600):
        try:
            monitor = socket.socket(socket.AF_UNIX)
            monitor.connect(path)
            return monitor.makefile("rw")
        except OSError:
            time.sleep(0.1)
    sys.exit("vm: FAILED: QEMU's monitor does not answer")


def ask(monitor, command, **arguments):
    monitor.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
    monitor.flush()
    while "return" not in (answer := json.loads(monitor.readline())) and "error" not in answer:
        pass
    return "return" in answer


def counts(path):
    """(orange pixels in the right half, grey ones that are not black in the left half, size)"""
    data = pathlib.Path(path).read_bytes()
    head = data.split(b"\n", 3)
    width, height = map(int, head[1].split())
    pixels = head[3]
    orange = lit = 0
    for y in range(0, height, 2):
        for x in range(0, width, 2):
            at = 3 * (y * width + x)
            r, g, b = pixels[at:at + 3]
            if x >= width // 2:
                orange += r > 150 and r > g + 40 and g > b
            else:
                lit += min(r, g, b) > 40
    return orange, lit, width, height


def main(address, picture, done, seconds):
    monitor = connect(address)
    monitor.readline()
    ask(monitor, "qmp_capabilities")
    seen = (0, 0, 0, 0)
    for _ in range(int(seconds) // 2):
        time.sleep(2)
        if not ask(monitor, "screendump", filename=picture):
            continue
        seen = counts(picture)
        if seen[0] > 200 and seen[1] > 5000:
            pathlib.Path(done).touch()
            print("vm: the screen is %dx%d: %d places of the drawing, %d of the camera's picture" % (seen[2:] + seen[:2]))
            return
    sys.exit("vm: FAILED: the machine's screen does not show the drawing: %s" % (seen,))


if __name__ == "__main__":
    main(*sys.argv[1:])
