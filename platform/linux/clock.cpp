// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/clock.h"

#include <chrono>
#include <thread>

namespace nt {

int64_t steady_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void sleep_until_ns(int64_t when_ns) {
  const int64_t wait_ns = when_ns - steady_now_ns();
  if (wait_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(wait_ns));
}

}  // namespace nt
