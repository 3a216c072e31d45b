// SPDX-License-Identifier: Apache-2.0
// The steady clock, in the shape core wants (NowNs), and a sleep until a point on it.
#pragma once
#include <cstdint>

namespace nt {

int64_t steady_now_ns();
void sleep_until_ns(int64_t when_ns);  // returns at once when the time has passed

}  // namespace nt
