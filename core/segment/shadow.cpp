// SPDX-License-Identifier: Apache-2.0
#include "core/segment/shadow.h"

namespace nt {

OtsuSplit otsu(const std::array<int, 256>& histogram) {
  int64_t total = 0, sum = 0, square = 0;
  for (int v = 0; v < 256; ++v) {
    const int64_t n = histogram[static_cast<std::size_t>(v)];
    total += n, sum += n * v, square += n * v * v;
  }
  OtsuSplit best;
  if (total == 0) return best;
  const double mean = static_cast<double>(sum) / static_cast<double>(total);
  const double variance = static_cast<double>(square) / static_cast<double>(total) - mean * mean;
  double best_between = 0;
  int64_t n0 = 0, s0 = 0;
  for (int v = 0; v < 255; ++v) {
    n0 += histogram[static_cast<std::size_t>(v)];
    s0 += static_cast<int64_t>(histogram[static_cast<std::size_t>(v)]) * v;
    const int64_t n1 = total - n0;
    if (n0 == 0) continue;
    if (n1 == 0) break;
    const double m0 = static_cast<double>(s0) / static_cast<double>(n0);
    const double m1 = static_cast<double>(sum - s0) / static_cast<double>(n1);
    const double w =
        static_cast<double>(n0) * static_cast<double>(n1) / (static_cast<double>(total) * static_cast<double>(total));
    const double between = w * (m1 - m0) * (m1 - m0);
    if (between > best_between) {
      best_between = between;
      best.threshold = v;
      best.low_mean = static_cast<float>(m0), best.high_mean = static_cast<float>(m1);
    }
  }
  best.eta = variance > 0 ? static_cast<float>(best_between / variance) : 0.0f;
  return best;
}

}  // namespace nt
