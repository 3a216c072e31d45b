#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a frame costs on boards that are not at hand: instructions and memory traffic, counted under QEMU, and the time they predict.

`./dev bench budget` gives the options. budget_run does the work of 16 frames, count_plugin.so counts it between markers, and this
adds up by stage and predicts. With --native the same program of this machine is counted and timed too, which shows how well a
prediction of this kind holds. --check FILE compares instructions with pinned ones (lines `NAME COUNT`) and says nothing else.
"""
import argparse
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

LINE_BYTES = 64
TOLERANCE = 0.03
FRAME_MS = 1000 / 60
CAPTURE = ["stabilise", "background", "clean", "components", "target", "refine", "outline", "landmarks", "motion"]
PIPELINE = CAPTURE + ["retarget", "lattice", "upload"]
BESIDES = ["placed", "placed_upload"]
FIGURES = ["instructions", "slow", "read", "written", "lines", "fetched", "written_back"]

# Instructions a cycle, cycles of a division or root, and bytes a second to and from memory: docs/PERFORMANCE.md says where from.
BOARDS = {
    "Cortex-A72, 1.5 GHz": {"ghz": 1.5, "ipc": 1.2, "slow_cycles": 20, "gb_s": 5.0},
    "Cortex-A76, 2.4 GHz": {"ghz": 2.4, "ipc": 2.0, "slow_cycles": 12, "gb_s": 9.0},
}


def run(command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"budget: {' '.join(map(str, command))}: {done.stderr.strip()[-300:] or 'failed'}")
    return done.stdout


def count(emulator, plugin, guest, film, characters):
    """Stage -> what it does in one frame; and what the guest says of itself."""
    with tempfile.TemporaryDirectory() as folder:
        counts = pathlib.Path(folder) / "counts.txt"
        said = run(emulator + ["-plugin", f"{plugin},out={counts}", guest, "count", film] + characters).splitlines()
        figures = [[int(word) for word in line.split()] for line in counts.read_text().splitlines()]
    notes = [line[2:] for line in said if line.startswith("#")]
    owners = [line for line in said if not line.startswith("#")]
    if len(owners) != len(figures) or not owners:
        sys.exit(f"budget: {len(owners)} intervals were marked and {len(figures)} counted")
    frames = int(notes[0].removeprefix("frames: "))
    stages = {}
    for owner, row in zip(owners, figures):
        if owner == "-":
            continue
        sums = stages.setdefault(owner, dict.fromkeys(FIGURES, 0))
        for name, value in zip(FIGURES, row):
            sums[name] += value / frames
    return stages, notes[1:]


def memory_bytes(stage):
    return LINE_BYTES * (stage["fetched"] + stage["written_back"])


def predict_us(stage, board):
    """Nothing overlaps: first all instructions, then all divisions, then all of memory."""
    cycles = stage["instructions"] / board["ipc"] + stage["slow"] * board["slow_cycles"]
    return cycles / board["ghz"] * 1e-3 + memory_bytes(stage) / board["gb_s"] * 1e-3


def total(stages, names):
    return {figure: sum(stages[name][figure] for name in names if name in stages) for figure in FIGURES}


def break_even_ipc(whole, board):
    """Of how few instructions a cycle half a core would still do."""
    left_us = FRAME_MS * 500 - predict_us({**whole, "instructions": 0}, board)
    return whole["instructions"] / (left_us * board["ghz"] * 1e3) if left_us > 0 else float("inf")


def table(stages, notes):
    rows = [(name, stages[name]) for name in PIPELINE if name in stages]
    whole = total(stages, PIPELINE)
    rows.append(("**total**", whole))
    out = ["; ".join(notes), "", f"| stage | instructions | divisions, roots | touched, KB | to and from memory, KB | {', us | '.join(BOARDS)}, us |",
           "| --- |" + " ---: |" * (4 + len(BOARDS))]
    for name, stage in rows + [(f"({name})", stages[name]) for name in BESIDES if name in stages]:
        times = " | ".join(f"{predict_us(stage, board):,.0f}" for board in BOARDS.values())
        out.append(f"| {name} | {stage['instructions']:,.0f} | {stage['slow']:,.0f} | {stage['lines'] * LINE_BYTES / 1e3:,.0f} "
                   f"| {memory_bytes(stage) / 1e3:,.0f} | {times} |")
    out.append("")
    for name, board in BOARDS.items():
        ms = predict_us(whole, board) * 1e-3
        out.append(f"{name}: {ms:.2f} ms a frame, {100 * ms / FRAME_MS:.0f} % of a core at 60 frames a second; half a core "
                   f"({FRAME_MS / 2:.2f} ms) {'holds' if ms <= FRAME_MS / 2 else 'DOES NOT HOLD'}, down to "
                   f"{break_even_ipc(whole, board):.2f} instructions a cycle ({board['ipc']} assumed)")
    return "\n".join(out)


def calibrate(native, emulator, plugin, film, characters, pinned):
    """The same model on this machine, its one free number fitted to the whole: predicted over measured, stage by stage."""
    stages, _ = count(emulator, plugin, native, film, characters)
    times_ns, ghz = {}, 0.0
    for line in run([native, "time", film] + characters + ["5"]).splitlines():
        if line.startswith("# ghz: "):
            ghz = float(line.removeprefix("# ghz: "))
        else:
            name, value = line.split()
            times_ns[name] = int(value)
    whole_ns, whole = sum(times_ns[name] for name in PIPELINE), total(stages, PIPELINE)["instructions"]
    per_ns = whole / whole_ns
    large = [name for name in PIPELINE if times_ns[name] >= 0.01 * whole_ns]
    ratios = {name: stages[name]["instructions"] / per_ns / times_ns[name] for name in large}
    counted = total(stages, CAPTURE)["instructions"]
    return {"ghz": ghz, "instructions": round(whole), "measured_us": whole_ns * 1e-3, "ipc": per_ns / ghz,
            "predicted_over_measured": {name: round(ratio, 2) for name, ratio in ratios.items()},
            "capture_by_qemu_over_callgrind": counted / pinned if pinned else None}


def calibration_text(c):
    stages = ", ".join(f"{name} {ratio}" for name, ratio in c["predicted_over_measured"].items())
    same = c["capture_by_qemu_over_callgrind"]
    return (f"\nThis machine: {c['instructions']:,} instructions of x86-64 a frame in {c['measured_us']:,.0f} us at {c['ghz']:.2f} GHz: "
            f"{c['ipc']:.2f} a cycle.\nWith that one number, predicted over measured: {stages}.\n"
            + (f"capture's instructions as QEMU counts them over those that callgrind counts: {same:.6f}.\n" if same else ""))


def read_pinned(path):
    lines = [line.split() for line in pathlib.Path(path).read_text().splitlines() if line and not line.startswith("#")]
    return {name: int(value) for name, value in lines}


def check(stages, path):
    kept = True
    groups = {"capture": CAPTURE, "retarget": ["retarget"], "lattice": ["lattice"], "upload": ["upload"]}
    for name, pinned in read_pinned(path).items():
        if any(stage not in stages for stage in groups[name]):
            continue  # counted without characters
        counted = total(stages, groups[name])["instructions"]
        off = counted / pinned - 1
        kept = kept and abs(off) <= TOLERANCE
        print(f"{name}: pinned {pinned}, now {counted:.0f}, {100 * off:+.2f} %" +
              ("" if abs(off) <= TOLERANCE else f"  <-- more than {100 * TOLERANCE:.0f} %"))
    return 0 if kept else 1


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--guest", required=True, help="budget_run for 64-bit ARM")
    parser.add_argument("--plugin", required=True, help="libcount_plugin.so")
    parser.add_argument("--emulator", required=True, help="qemu-aarch64 and its options, as one word")
    parser.add_argument("--characters", nargs=2, default=[], metavar=("FLAT", "SOLID"))
    parser.add_argument("--native", help="budget_run for this machine")
    parser.add_argument("--callgrind", help="tests/bench/instructions.txt, to compare with what QEMU counts here")
    parser.add_argument("--check", metavar="FILE")
    parser.add_argument("--json", action="store_true")
    return parser.parse_args()


def main():
    options = parsed()
    emulator = shlex.split(options.emulator)
    with tempfile.TemporaryDirectory() as folder:
        film = f"{folder}/film.raw"
        run(emulator + [options.guest, "film", film] if not options.native else [options.native, "film", film])
        stages, notes = count(emulator, options.plugin, options.guest, film, options.characters)
        if options.check:
            return check(stages, options.check)
        pinned = read_pinned(options.callgrind).get("960x544") if options.callgrind else None
        calibration = calibrate(options.native, ["qemu-x86_64", "-cpu", "max"], options.plugin, film, options.characters,
                                pinned) if options.native else None
    if options.json:
        predictions = {name: {"total_us": round(predict_us(total(stages, PIPELINE), board)), **board,
                              "stages_us": {stage: round(predict_us(stages[stage], board), 1) for stage in stages}}
                       for name, board in BOARDS.items()}
        print(json.dumps({"stages": stages, "boards": predictions, "notes": notes, "this_machine": calibration}, indent=2))
    else:
        print(table(stages, notes) + ("\n" + calibration_text(calibration) if calibration else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
