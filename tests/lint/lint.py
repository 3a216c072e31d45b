#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rules of the house that a compiler does not check. `lint.py ROOT` prints one line per offence; exit 1 if any.

Layers (a folder may include itself, base/ and what stands before it), what core may not touch, SPDX lines, file
lengths, links in the documentation, names of this machine.
"""
import pathlib
import re
import subprocess
import sys

CORE_ORDER = ["base", "frame", "stabilise", "segment", "outline", "landmarks", "motion", "scene", "deform", "character", "pipeline"]
MAX_LINES = 500
CORE_FORBIDDEN_HEADERS = re.compile(
    r"^(iostream|fstream|sstream|iomanip|vector|string|string_view|deque|list|map|set|unordered_map|unordered_set|"
    r"thread|mutex|atomic|condition_variable|future|chrono|ctime|time\.h|cmath|math\.h|functional|memory|exception|"
    r"stdexcept|cstdio|stdio\.h|cstdlib|stdlib\.h|filesystem|random|typeinfo|"
    r"(opencv2|SDL2?|GLES\d?|EGL|GL|sys|linux)/.*|unistd\.h)$")
CORE_FORBIDDEN_CODE = [
    (re.compile(r"\b(malloc|calloc|realloc|free|aligned_alloc)\s*\("), "heap"),
    (re.compile(r"\bnew\s+(?!\()[A-Za-z_:]"), "heap (only placement new into an arena)"),
    (re.compile(r"\bdelete\b(?!\s*[;,])"), "heap"),
    (re.compile(r"\b(throw|try|catch)\b"), "exceptions"),
    (re.compile(r"\b(dynamic_cast|typeid)\b"), "RTTI"),
    (re.compile(r"\bstd::(sqrt|sin|cos|tan|a?tan2?|asin|acos|exp2?|log(2|10)?|pow|hypot|fma|floor|ceil|l?round|fmod|"
                r"vector|string|function|map|thread|mutex)\b"), "libm or a container; use core/base/det_math.h"),
    (re.compile(r"\b(__builtin_)?(sin|cos|tan|atan2?|exp|log|pow|hypot|fma|floor|ceil)f\s*\(|\b__builtin_(?!sqrtf?\b)"
                r"(sin|cos|exp|log|pow|fma)\s*\("), "libm; use core/base/det_math.h"),
    (re.compile(r"\b(Neg)?MulAdd\s*\(|\bMulSub\s*\("), "fused multiply-add, whose bits differ by target; Mul, then Add"),
    (re.compile(r"\bthread_local\b"), "threads"),
]
SCRIPT_SUFFIXES = {".h", ".cpp", ".cmake", ".py", ".sh", ".txt", ".vert", ".frag"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
MACHINE_NAMES = re.compile(r"/work/(main|shared|\.)|/home/\w+/|/tmp/")
STRAY = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b|^(<{7}|>{7}) ", re.MULTILINE)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def strip(source):
    """C++ without comments and strings, line numbers kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)
    return pattern.sub(lambda m: "\n" * m.group().count("\n") + " ", source)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def layer_of(path):
    """('core', 'segment') for core/segment/clean.h; ('app', None) for app/main.cpp."""
    parts = pathlib.PurePosixPath(path).parts
    return parts[0], (parts[1] if len(parts) > 2 else None)


def may_include(path, target):
    top, folder = layer_of(path)
    to_top, to_folder = layer_of(target)
    if to_top in ("hwy", "Eigen"):
        return True
    if top == "core":
        if to_top != "core":
            return False
        if folder not in CORE_ORDER or to_folder not in CORE_ORDER:
            return False
        return CORE_ORDER.index(to_folder) <= CORE_ORDER.index(folder)
    if top == "platform":
        return to_top in ("core", "platform")
    if top == "app":
        return to_top in ("core", "platform", "app")
    return True


def check_includes(path, text):
    for match in INCLUDE.finditer(text):
        kind, target = match.groups()
        line = line_of(text, match.start(2))
        if kind == '"' and not may_include(path, target):
            yield line, f"{target} is not to the left of {path.rsplit('/', 1)[0]}: see docs/ARCHITECTURE.md"
        if kind == "<" and path.startswith("core/") and CORE_FORBIDDEN_HEADERS.match(target):
            yield line, f"core may not include <{target}>"


def check_core_code(text):
    code = strip(text)
    for pattern, why in CORE_FORBIDDEN_CODE:
        for match in pattern.finditer(code):
            yield line_of(code, match.start()), f"core may not use `{match.group().strip()}`: {why}"


def check_text(path, text):
    lines = text.splitlines()
    suffix = pathlib.PurePosixPath(path).suffix
    is_script = suffix in SCRIPT_SUFFIXES or text.startswith("#!")
    if is_script and not any("SPDX-License-Identifier: Apache-2.0" in line for line in lines[:2]):
        yield 1, "the SPDX line is missing"
    if len(lines) > MAX_LINES and (is_script or suffix == ".md"):
        yield len(lines), f"{len(lines)} lines; {MAX_LINES} are enough, split it"
    if path == "tests/lint/lint.py":
        return  # it spells out what it looks for
    for pattern, why in ((MACHINE_NAMES, "a path of one machine"), (STRAY, "unfinished work")):
        for match in pattern.finditer(text):
            yield line_of(text, match.start()), f"`{match.group()}`: {why}"


def check_links(root, path, text):
    for match in LINK.finditer(text):
        target = match.group(1).split("#")[0]
        if not target or re.match(r"[a-z]+:", target):
            continue
        if not (root / path).parent.joinpath(target).exists():
            yield line_of(text, match.start()), f"the link to {target} leads nowhere"


def check_file(root, path):
    data = (root / path).read_bytes()
    if b"\0" in data:
        return
    text = data.decode("utf-8")
    yield from check_text(path, text)
    if path.endswith((".h", ".cpp")):
        yield from check_includes(path, text)
        if path.startswith("core/"):
            yield from check_core_code(text)
    if path.endswith(".md"):
        yield from check_links(root, path, text)


def files_of(root):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, text=True)
    if listed.returncode == 0:
        return [p for p in sorted(set(listed.stdout.splitlines())) if (root / p).is_file() and p != "LICENSE"]
    # A release archive has no git: everything but the build is ours.
    return [p.relative_to(root).as_posix() for p in sorted(root.rglob("*"))
            if p.is_file() and p.name != "LICENSE" and p.relative_to(root).parts[0] not in ("build", "out")]


def lint(root):
    return [f"{path}:{line}: {what}" for path in files_of(root) for line, what in check_file(root, path)]


if __name__ == "__main__":
    offences = lint(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(offences) if offences else "lint: clean")
    sys.exit(1 if offences else 0)
