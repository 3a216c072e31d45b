#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The lint sees each offence that it is there for, and lets clean files pass."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import lint  # noqa: E402

SPDX = "// SPDX-License-Identifier: Apache-2.0\n"


def offences(path, text):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
        return lint.lint(root)


class LintTest(unittest.TestCase):
    def rejects(self, path, text, word):
        found = offences(path, text)
        self.assertTrue(any(word in line for line in found), f"{path} passed: {text!r}; found {found}")

    def accepts(self, path, text):
        self.assertEqual(offences(path, text), [])

    def test_folders_include_only_to_their_left(self):
        self.accepts("core/outline/a.h", SPDX + '#include "core/segment/b.h"\n#include "core/base/c.h"\n')
        self.rejects("core/segment/a.h", SPDX + '#include "core/outline/b.h"\n', "not to the left")
        self.rejects("core/base/a.h", SPDX + '#include "core/frame/frame.h"\n', "not to the left")
        self.rejects("core/base/a.h", SPDX + '#include "platform/camera.h"\n', "not to the left")
        self.rejects("core/newfolder/a.h", SPDX + '#include "core/base/b.h"\n', "not to the left")
        self.rejects("platform/sim/a.h", SPDX + '#include "app/cli.h"\n', "not to the left")
        self.accepts("app/a.h", SPDX + '#include "platform/camera.h"\n')

    def test_core_has_no_heap_exceptions_libm_or_threads(self):
        for header in ("vector", "string", "iostream", "thread", "mutex", "cmath", "functional", "map",
                       "opencv2/core.hpp", "SDL2/SDL.h", "GLES3/gl3.h"):
            self.rejects("core/base/a.h", SPDX + f"#include <{header}>\n", "may not include")
        for code in ("int* p = new int;", "void* p = malloc(3);", "throw 1;", "float a = std::sin(b);", "x = sinf(y);",
                     "auto v = hn::MulAdd(a, b, c);", "thread_local int a;", "delete p;"):
            self.rejects("core/base/a.cpp", SPDX + code + "\n", "may not use")

    def test_core_may_place_name_and_explain(self):
        self.accepts("core/base/a.cpp", SPDX + "new (first + i) T{};\nA(const A&) = delete;\nfloat s = det::sin(a);\n"
                     "// no malloc() here, and new things are explained\nSinCos r = sincos(a);\nv.sin(a);\n")

    def test_files_carry_the_licence_and_stay_short(self):
        self.rejects("app/a.cpp", "int a;\n", "SPDX")
        self.rejects("dev", "#!/bin/sh\necho\n", "SPDX")
        self.rejects("app/a.cpp", SPDX + "int a;\n" * 500, "lines")
        self.accepts("app/a.cpp", SPDX + "int a;\n" * 499)

    def test_documents_link_to_files_that_exist(self):
        self.rejects("README.md", "[x](docs/NONE.md)\n", "leads nowhere")
        self.accepts("README.md", "[x](README.md#try-it) [y](https://example.org)\n")

    def test_nothing_names_a_machine_or_is_unfinished(self):
        self.rejects("app/a.cpp", SPDX + "// see /" + "tmp/x\n", "one machine")
        self.rejects("app/a.cpp", SPDX + "// TO" + "DO later\n", "unfinished")
        self.rejects("docs/A.md", "<" * 7 + " HEAD\n", "unfinished")


if __name__ == "__main__":
    unittest.main()
