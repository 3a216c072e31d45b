#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the machine saw against what was expected; one line, exit 1 where they differ.

compare.py known EXPECTED SEEN      every frame seen is one of those expected, and more than one of them is seen
compare.py same EXPECTED SEEN EXPECTED_POSES POSES   frames and poses are the same, one by one; times may differ
compare.py order EXPECTED SEEN      which of the clip's frames were seen: in order, round and round, two at most dropped on the way
compare.py kept EXPECTED_POSES POSES  the recording that was cut short begins as the whole one and has a second at least
"""
import csv
import sys


def rows(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def hashes(path):
    return [row["luma_fnv1a64"] for row in rows(path)]


def poses(path):
    return [{key: value for key, value in row.items() if key != "t_s"} for row in rows(path)]


def first_difference(expected, seen):
    for i, (a, b) in enumerate(zip(expected, seen)):
        if a != b:
            return i
    return None if len(expected) == len(seen) else min(len(expected), len(seen))


def known(expected, seen):
    clip, got = hashes(expected), hashes(seen)
    strangers = [i for i, value in enumerate(got) if value not in clip]
    if strangers or len(set(got)) < 2:
        return f"{seen}: frames {strangers} of {len(got)} are none of the clip's; {len(set(got))} different ones came"
    print(f"vm: {seen}: {len(got)} frames, each with the bytes of one of the clip's {len(clip)}")
    return None


def same(expected, seen, expected_poses, seen_poses):
    for what, a, b in (("frame", hashes(expected), hashes(seen)), ("pose", poses(expected_poses), poses(seen_poses))):
        at = first_difference(a, b)
        if at is not None:
            return f"{seen}: {what} {at} is another than that of the file ({len(b)} of {len(a)} came)"
    found = sum(row["status"] == "ok" for row in poses(seen_poses))
    if found < len(hashes(seen)) // 2:
        return f"{seen_poses}: only {found} poses; the clip shows nothing"
    print(f"vm: {seen}: {len(hashes(seen))} frames and poses as from the file, {found} with a pose")
    return None


def order(expected, seen):
    clip, got = hashes(expected), hashes(seen)
    strangers = [i for i, value in enumerate(got) if value not in clip]
    if strangers or not got:
        return f"{seen}: frames {strangers} of {len(got)} are none of the clip's"
    places = [clip.index(value) for value in got]
    steps = [(b - a) % len(clip) for a, b in zip(places, places[1:])]
    if any(step not in (1, 2) for step in steps) or steps.count(2) > 2:
        return f"{seen}: these are not the clip's frames in order: {places}"
    print(*places)
    return None


def kept(expected_poses, seen_poses):
    whole, part = poses(expected_poses), poses(seen_poses)
    at = first_difference(whole[:len(part)], part[:len(whole)])
    if at is not None or len(part) < 10:
        return f"{seen_poses}: {len(part)} rows kept, the first other one is {at}"
    print(f"vm: {seen_poses}: {len(part)} rows kept of the camera that was pulled")
    return None


if __name__ == "__main__":
    # Run paths are of the machine that runs it: only the names matter.
    complaint = {"known": known, "same": same, "order": order, "kept": kept}[sys.argv[1]](*sys.argv[2:])
    if complaint:
        sys.exit("vm: FAILED: " + complaint)
