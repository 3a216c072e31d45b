// SPDX-License-Identifier: Apache-2.0
#include "core/outline/smoother.h"

namespace nt {

StationValues smoothed(const StationValues& values, const StationValues& weights, float lambda) {
  constexpr std::size_t n = kStations;
  // W + lambda D'D is symmetric with bandwidth 2: main diagonal a, first b, second c; D has rows 1 -2 1.
  std::array<double, n> a{}, b{}, c{}, x{};
  for (std::size_t j = 0; j < n; ++j) a[j] = weights[j] + 1e-9, x[j] = static_cast<double>(weights[j]) * values[j];
  for (std::size_t j = 0; j + 2 < n; ++j) {
    a[j] += lambda, a[j + 1] += 4.0 * lambda, a[j + 2] += lambda;
    b[j] -= 2.0 * lambda, b[j + 1] -= 2.0 * lambda;
    c[j] += lambda;
  }
  // L D L' in place: b and c become the factors below the diagonal.
  for (std::size_t j = 0; j < n; ++j) {
    const double b1 = b[j] / a[j], c1 = c[j] / a[j];
    if (j + 1 < n) a[j + 1] -= b1 * b[j], b[j + 1] -= b1 * c[j], x[j + 1] -= b1 * x[j];
    if (j + 2 < n) a[j + 2] -= c1 * c[j], x[j + 2] -= c1 * x[j];
    b[j] = b1, c[j] = c1;
  }
  StationValues out{};
  for (std::size_t j = n; j-- > 0;) {
    x[j] /= a[j];
    if (j + 1 < n) x[j] -= b[j] * x[j + 1];
    if (j + 2 < n) x[j] -= c[j] * x[j + 2];
    out[j] = static_cast<float>(x[j]);
  }
  return out;
}

StationValues lower_envelope(const StationValues& values, float lambda) {
  constexpr float kAbove = 0.01f;  // weight of a value above the curve
  StationValues weights, curve = values;
  for (float& w : weights) w = 1;
  for (int round = 0; round < 6; ++round) {
    curve = smoothed(values, weights, lambda);
    for (std::size_t j = 0; j < kStations; ++j) weights[j] = values[j] > curve[j] ? kAbove : 1.0f;
  }
  return curve;
}

}  // namespace nt
