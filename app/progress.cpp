// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

#include "platform/linux/clock.h"

namespace nt {

Progress::Progress(int64_t total) : total_(total), on_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (on_) std::fputs("\r                              \r", stderr);
}

void Progress::show(int64_t done) {
  if (!on_ || steady_now_ns() < next_ns_) return;
  next_ns_ = steady_now_ns() + 100'000'000;
  if (total_ > 0) {
    std::fprintf(stderr, "\rframe %lld of %lld", static_cast<long long>(done), static_cast<long long>(total_));
  } else {
    std::fprintf(stderr, "\rframe %lld", static_cast<long long>(done));
  }
}

}  // namespace nt
