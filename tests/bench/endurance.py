#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A long run of `neontetra live` on the simulated tank, drawn off-screen and recorded in a take: does memory stay flat, is every
frame captured and recorded, does no step of core take long?

`./dev bench endurance` gives the options. The tank's frames come when a camera would have them; a frame that is not fetched in time is
dropped. Memory is the process's resident set, looked at every second; it is flat if no tenth of the run after the first has a
median above that of the second by 1 MB. The camera's and core's threads are given real-time priority where that is allowed, as on a
board: without a GPU the drawing takes every processor. Exit code 1 if one of the three is not kept.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

MOST_DRIFT_BYTES = 1 << 20
MOST_SPREAD = 3.0  # the 99.9th percentile of core's step over its median
MB = 1e6


def resident_bytes(pid):
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return 1024 * int(line.split()[1])
    except OSError:
        pass
    return None  # it has ended


def watch(command, seconds):
    """Runs it; its resident bytes, one a second."""
    samples, began, told = [], time.monotonic(), 0
    with subprocess.Popen(command) as process:
        while process.poll() is None:
            now = resident_bytes(process.pid)
            if now:
                samples.append(now)
            elapsed = time.monotonic() - began
            if now and elapsed - told >= 30:
                told = elapsed
                print(f"endurance: {elapsed:.0f} s of about {seconds:.0f} s, {now / MB:.1f} MB", file=sys.stderr)
            time.sleep(1)
    if process.returncode != 0:
        sys.exit(f"endurance: {' '.join(command)}: exit code {process.returncode}")
    return samples


def drift(samples):
    """Of the medians of tenths, from the second on: how far one rises above the second. None where the run is too short."""
    tenth = len(samples) // 10
    if tenth < 1:
        return None
    medians = [statistics.median(samples[k * tenth:(k + 1) * tenth]) for k in range(1, 10)]
    return max(medians) - medians[0]


def priority():
    """Options of the program; none where this user may not ask for it."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(20))
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    except PermissionError:
        print("endurance: no right to real-time priority (ulimit -r), so the steps are less even", file=sys.stderr)
        return []
    return ["--priority", "camera=10", "--priority", "core=20"]


def judge(report, wanted, samples):
    total = report["stages_us"]["total"]
    spread = total["p999"] / total["median"]
    rise = drift(samples)
    return {
        "frames": report["frames"], "frames_wanted": wanted, "frames_dropped": report["frames_dropped"],
        "frames_not_stored": report["loop"]["frames_not_stored"],
        "no_frame_dropped": report["frames_dropped"] == 0 and report["loop"]["frames_not_stored"] == 0 and report["frames"] == wanted,
        "rss_drift_bytes": rise, "rss_peak_bytes": max(samples, default=0), "memory_flat": rise is not None and rise < MOST_DRIFT_BYTES,
        "step_median_us": total["median"], "step_p999_us": total["p999"], "step_p999_over_median": round(spread, 2),
        "steps_even": spread < MOST_SPREAD,
    }


def text(r):
    def kept(what):
        return "kept" if r[what] else "NOT KEPT"
    rise = "too short a run to say" if r["rss_drift_bytes"] is None else f"{r['rss_drift_bytes'] / MB:.2f} MB"
    return (f"frames: {r['frames']} of {r['frames_wanted']}, {r['frames_dropped']} dropped, {r['frames_not_stored']} not recorded: {kept('no_frame_dropped')}\n"
            f"memory: drift {rise}, peak {r['rss_peak_bytes'] / MB:.1f} MB; under {MOST_DRIFT_BYTES / MB:.2f}: {kept('memory_flat')}\n"
            f"core's step: median {r['step_median_us']:.0f} us, 99.9th percentile {r['step_p999_us']:.0f} us, ratio "
            f"{r['step_p999_over_median']:.2f}; under {MOST_SPREAD:.0f}: {kept('steps_even')}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0].replace("\n", " "))
    parser.add_argument("--neontetra", required=True, help="the program")
    parser.add_argument("--character", required=True, help="FILE.ntchar")
    parser.add_argument("--frames", type=int, default=100000)
    parser.add_argument("--fps", type=float, default=60, help="at which the tank is filmed (default 60)")
    parser.add_argument("--display", default="egl", help="egl (default), or null: nothing is drawn")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    # Beside the program, because /tmp may be memory.
    with tempfile.TemporaryDirectory(dir=pathlib.Path(options.neontetra).parent) as folder:
        report = pathlib.Path(folder) / "report.json"
        samples = watch([options.neontetra, "live", "--camera", f"sim:scene=long,seed=1,fps={options.fps:g}", "--frames", str(options.frames),
                         "--background", "vibe", "--display", options.display, "--character", options.character,
                         "--take", f"{folder}/long.take", "--json", str(report), *priority()], options.frames / options.fps)
        result = judge(json.loads(report.read_text()), options.frames, samples)
    print(json.dumps(result, indent=2) if options.json else text(result))
    return 0 if result["no_frame_dropped"] and result["memory_flat"] and result["steps_even"] else 1


if __name__ == "__main__":
    sys.exit(main())
