// SPDX-License-Identifier: Apache-2.0
// Runs the real neontetra binary as a user would, and what it left behind.
#pragma once
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temp_dir.h"

namespace nt {

inline std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
  int error_lines() const { return static_cast<int>(std::count(err.begin(), err.end(), '\n')); }
};

// `arguments` as typed into a shell, redirections included. `largest_file_kib` > 0: no file may grow past it, as on a full disk.
inline Outcome neontetra(const std::string& arguments, int largest_file_kib = 0) {
  const TempDir dir;
  std::string command = "{ " NEONTETRA_BINARY " " + arguments + "; } >" + (dir / "out") + " 2>" + (dir / "err");
  if (largest_file_kib > 0) command = "ulimit -f " + std::to_string(largest_file_kib * 2) + "; " + command;
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  outcome.out = read_text((dir / "out"));
  outcome.err = read_text((dir / "err"));
  return outcome;
}

}  // namespace nt
