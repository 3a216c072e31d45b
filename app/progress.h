// SPDX-License-Identifier: Apache-2.0
// "frame 120 of 385" on stderr while a command works; silent where stderr is no terminal.
#pragma once
#include <cstdint>

namespace nt {

class Progress {
 public:
  explicit Progress(int64_t total);  // -1: not known
  ~Progress();                       // wipes the line
  void show(int64_t done);           // at most ten times a second

 private:
  int64_t total_;
  int64_t next_ns_ = 0;
  bool on_;
};

}  // namespace nt
