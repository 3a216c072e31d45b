// SPDX-License-Identifier: Apache-2.0
// A fish that beats its tail (20 frames a beat) and swims to the right, 4 pixels a frame, for the tests of edits.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/motion/property.h"

namespace nt {

inline std::vector<Motion> swimming(int frames) {
  std::vector<Motion> m(static_cast<std::size_t>(frames), straight_motion(3, 15));
  for (int i = 0; i < frames; ++i) {
    Motion& frame = m[static_cast<std::size_t>(i)];
    const float phase = 2 * 3.14159265f * static_cast<float>(i) / 20;
    frame.time_ns = i * int64_t{33'333'333};
    frame.status = PoseStatus::ok;
    frame.confidence = {1, 1, 1, 0, 0, 1};
    frame.tail_angle += 0.5f * std::sin(phase);
    for (int b = 0; b < 15; ++b)
      frame.low_axis_angle[b] += 0.02f * static_cast<float>(b) * std::sin(phase - 0.1f * static_cast<float>(b));
    frame.centre = {100 + 4 * static_cast<float>(i), 200};
  }
  return m;
}

}  // namespace nt
