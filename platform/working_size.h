// SPDX-License-Identifier: Apache-2.0
// The working size of a source: the largest of its aspect that fits work_width x work_height, never larger than the source.
//
// Pixels; most_pixels > 0 limits width x height too.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nt {

struct WorkSize {
  int width = 0, height = 0;
};

inline WorkSize working_size(int source_width, int source_height, int work_width, int work_height,
                             int64_t most_pixels = 0) {
  double scale =
      std::min({1.0, static_cast<double>(work_width) / source_width, static_cast<double>(work_height) / source_height});
  const double pixels = static_cast<double>(source_width) * source_height;
  if (most_pixels > 0) scale = std::min(scale, std::sqrt(static_cast<double>(most_pixels) / pixels));
  const auto side = [scale](int source, int limit) {
    return std::clamp(static_cast<int>(std::lround(source * scale)), 1, std::max(1, limit));
  };
  return {side(source_width, work_width), side(source_height, work_height)};
}

}  // namespace nt
