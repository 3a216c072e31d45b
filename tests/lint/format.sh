#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# format.sh ROOT: every C++ file is as clang-format would lay it out. `./dev format` puts it right.
set -euo pipefail
cd "$1"
{ git ls-files '*.h' '*.cpp' 2>/dev/null || find app core platform tests -name '*.h' -o -name '*.cpp'; } |
  xargs clang-format --dry-run --Werror
