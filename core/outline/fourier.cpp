// SPDX-License-Identifier: Apache-2.0
#include "core/outline/fourier.h"

#include "core/base/det_math.h"

namespace nt {

void arc_lengths(std::span<const Vec2> contour, std::span<float> arc, int reach) {
  const int n = static_cast<int>(contour.size());
  const float share = 1.0f / static_cast<float>(2 * reach + 1);
  arc[0] = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 before = contour[static_cast<std::size_t>((i - reach % n + n) % n)];
    const Vec2 after = contour[static_cast<std::size_t>((i + 1 + reach) % n)];
    arc[static_cast<std::size_t>(i) + 1] = arc[static_cast<std::size_t>(i)] + share * length(after - before);
  }
}

EllipticFourier fit_fourier(std::span<const Vec2> contour, std::span<const float> arc, int harmonics) {
  EllipticFourier f;
  f.harmonics = harmonics < kMaxHarmonics ? harmonics : kMaxHarmonics;
  const std::size_t n = contour.size();
  const double T = arc[n];
  if (T <= 0) return f;
  double cos_before[kMaxHarmonics], sin_before[kMaxHarmonics];
  for (int k = 0; k < f.harmonics; ++k) cos_before[k] = 1, sin_before[k] = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const Vec2 from = contour[p], to = contour[(p + 1) % n];
    const double dx = to.x - from.x, dy = to.y - from.y, dt = static_cast<double>(arc[p + 1]) - arc[p];
    if (dt <= 0) continue;
    f.a0 += 0.5 * (static_cast<double>(from.x) + to.x) * dt;
    f.c0 += 0.5 * (static_cast<double>(from.y) + to.y) * dt;
    const det::SinCos one = det::sincos(static_cast<float>(2.0 * det::kPi * arc[p + 1] / T));
    double ck = 1, sk = 0;
    for (int k = 0; k < f.harmonics; ++k) {
      const double next = ck * one.cos - sk * one.sin;  // cos and sin of (k + 1) phi_p
      sk = sk * one.cos + ck * one.sin;
      ck = next;
      f.a[k] += dx / dt * (ck - cos_before[k]);
      f.b[k] += dx / dt * (sk - sin_before[k]);
      f.c[k] += dy / dt * (ck - cos_before[k]);
      f.d[k] += dy / dt * (sk - sin_before[k]);
      cos_before[k] = ck, sin_before[k] = sk;
    }
  }
  f.a0 /= T, f.c0 /= T;
  for (int k = 0; k < f.harmonics; ++k) {
    const double order = k + 1;
    const double scale = T / (2 * order * order * static_cast<double>(det::kPi) * static_cast<double>(det::kPi));
    f.a[k] *= scale, f.b[k] *= scale, f.c[k] *= scale, f.d[k] *= scale;
  }
  return f;
}

Vec2 EllipticFourier::at(float t) const {
  const det::SinCos one = det::sincos(det::kTwoPi * t);
  double ck = 1, sk = 0, x = a0, y = c0;
  for (int k = 0; k < harmonics; ++k) {
    const double next = ck * one.cos - sk * one.sin;
    sk = sk * one.cos + ck * one.sin;
    ck = next;
    x += a[k] * ck + b[k] * sk;
    y += c[k] * ck + d[k] * sk;
  }
  return {static_cast<float>(x), static_cast<float>(y)};
}

}  // namespace nt
