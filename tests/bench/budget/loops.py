#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many instructions a cycle a Cortex-A72 could do in our inner loops, by llvm-mca, to judge the number that budget.py assumes.

`./dev bench budget --loops`. Takes budget_run for 64-bit ARM apart with objdump, finds the innermost loops of the functions that
execute most, and gives each to llvm-mca, which goes round it 200 times: dependences, units and latencies count, caches that miss and branches that are
mispredicted do not. LLVM 14 takes the older Cortex-A57 for the A72.
"""
import argparse
import re
import subprocess
import sys

# By what callgrind says of the whole frame.
FUNCTIONS = ["Lattice::gather_block(", "Lattice::sum_shape(", "Lattice::spread_bone_shift(", "SparseLdlt::solve(", "newton_rotations(",
             "Mls::sum_block(", "classify_planes(", "follow_background(", "Refine::fish_in(", "nearest_from("]
LEAST_INSTRUCTIONS = 6  # shorter ones are ends of rows


def run(command, text=None):
    done = subprocess.run(command, input=text, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"loops: {command[0]}: {done.stderr.strip()[:300] or 'failed'}")
    return done.stdout


def functions(program):
    """Name -> its instructions: address and text."""
    found, here = {}, None
    for line in run(["aarch64-linux-gnu-objdump", "-d", "-C", "--no-show-raw-insn", program]).splitlines():
        begin = re.match(r"[0-9a-f]+ <(.*)>:$", line)
        if begin:
            here = found.setdefault(begin[1], []) if any(name in begin[1] for name in FUNCTIONS) else None
        instruction = re.match(r"\s+([0-9a-f]+):\s+(.*)", line)
        if here is not None and instruction:
            here.append((int(instruction[1], 16), instruction[2].split("//")[0].strip()))
    return found


def inner_loops(code):
    """Texts between the target of a branch backwards and that branch, where no other such branch lies between."""
    index = {address: i for i, (address, _) in enumerate(code)}
    spans = []
    for i, (_, text) in enumerate(code):
        branch = re.match(r"(?:b|b\.\w+|cbn?z|tbn?z)\s+(?:.*,\s*)?([0-9a-f]+) <", text)
        if branch and index.get(int(branch[1], 16), i) < i:
            spans.append((index[int(branch[1], 16)], i))
    for first, last in spans:
        body = [text for _, text in code[first:last + 1]]
        nested = any((a, b) != (first, last) and a >= first and b <= last for a, b in spans)
        if not nested and len(body) >= LEAST_INSTRUCTIONS and not any(text.startswith("bl") for text in body):
            yield body


def instructions_a_cycle(body):
    text = "loop:\n" + "\n".join(re.sub(r"[0-9a-f]+ <.*>", "loop", line) for line in body) + "\n"
    said = run(["llvm-mca", "-march=aarch64", "-mcpu=cortex-a72", "-iterations=200"], text)
    return float(re.search(r"^IPC:\s+([\d.]+)", said, re.MULTILINE)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("program", help="budget_run for 64-bit ARM")
    rows = []
    for name, code in functions(parser.parse_args().program).items():
        short = next(known for known in FUNCTIONS if known in name).rstrip("(")
        rows += [(instructions_a_cycle(body), len(body), short) for body in inner_loops(code)]
    if not rows:
        sys.exit("loops: none of the functions was found: are they called otherwise now?")
    for rate, length, name in sorted(rows):
        print(f"{rate:.2f} a cycle, {length:3} instructions, {name}")
    rates = sorted(rate for rate, _, _ in rows)
    print(f"{len(rates)} inner loops: {rates[0]:.2f} to {rates[-1]:.2f} instructions a cycle, median {rates[len(rates) // 2]:.2f}")


if __name__ == "__main__":
    main()
