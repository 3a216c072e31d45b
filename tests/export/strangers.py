# SPDX-License-Identifier: Apache-2.0
"""Public readers that know nothing of Neontetra: pandas opens the CSV as pose tools do, the assimp command the GLB.

strangers.py TABLE.csv FILE.glb ...

Says what they found. Exits with 1 where a file is not what its format promises: numbers that are none, a likelihood outside of
0..1, a place without one, a GLB without a skinned, textured mesh or an animation of its joints.
"""
import re
import subprocess
import sys

import pandas


def check(what, holds):
    if not holds:
        sys.exit(f"strangers: {what}")


def read_table(path):
    table = pandas.read_csv(path, header=[0, 1, 2], index_col=0)  # as DeepLabCut's own tools do
    check("three header rows", list(table.columns.names) == ["scorer", "bodyparts", "coords"])
    parts = list(dict.fromkeys(table.columns.get_level_values("bodyparts")))
    check("x, y, likelihood of each part", len(table.columns) == 3 * len(parts) > 0)
    check("numbers", all(kind.kind in "fi" for kind in table.dtypes))
    x, y, likelihood = (table.xs(name, axis=1, level="coords").to_numpy() for name in ("x", "y", "likelihood"))
    check("likelihoods", bool(((likelihood >= 0) & (likelihood <= 1)).all()))
    seen = likelihood > 0
    check("a place for each part that was seen, and there alone", bool(((x == x) == seen).all() and ((y == y) == seen).all()))
    check("a part that was seen", bool(seen.any()))
    print(f"pandas: {path}: {len(table)} frames, {len(parts)} parts, {100 * seen.mean():.0f} % of them seen")


def read_model(path):
    said = subprocess.run(["assimp", "info", path], capture_output=True, text=True, check=False)
    check(f"{path}: {said.stdout[-300:]}{said.stderr[-300:]}", said.returncode == 0)
    counts = {name.lower(): int(number) for name, number in re.findall(r"^([A-Z][A-Za-z .()]+?):\s+(\d+)\s*$", said.stdout, re.M)}
    check(f"{path}: a skinned mesh", counts.get("meshes", 0) >= 1 and counts.get("bones", 0) > 1)
    check(f"{path}: its texture", counts.get("textures (embed.)", 0) >= 1)
    channels = counts.get("animation channels", 0)
    check(f"{path}: an animation of its joints", counts.get("animations", 0) == 1 and channels > 1)
    print(f"assimp: {path}: {counts['vertices']} vertices, {counts['bones']} bones, {channels} animated joints")


def main():
    read_table(sys.argv[1])
    for path in sys.argv[2:]:
        read_model(path)


main()
