// SPDX-License-Identifier: Apache-2.0
// Otsu's threshold, with which [F] section 4 takes the shadow away.
//
// Source: Otsu 1979. `eta` = sigma_b^2 / sigma_t^2 says how well two classes separate; a fish without a shadow must not be
// cut in two, so the caller applies the threshold only where eta is high.
#pragma once
#include <array>
#include <cstdint>

namespace nt {

struct OtsuSplit {
  int threshold = 0;  // the low class is v <= threshold
  float eta = 0;      // 0..1
  float low_mean = 0, high_mean = 0;
};

// Sums are integers and the rest is IEEE double without contraction: the same threshold on every target.
OtsuSplit otsu(const std::array<int, 256>& histogram);

}  // namespace nt
