// SPDX-License-Identifier: Apache-2.0
#include "core/outline/fourier.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

EllipticFourier fit(const std::vector<Vec2>& contour, int harmonics) {
  std::vector<float> arc(contour.size() + 1);
  arc_lengths(contour, arc);
  return fit_fourier(contour, arc, harmonics);
}

TEST(Fourier, ArcLengthsRunRoundToThePerimeter) {
  const std::vector<Vec2> square{{0, 0}, {3, 0}, {3, 3}, {3, 3}, {0, 3}};
  std::vector<float> arc(6);
  arc_lengths(square, arc);
  const std::vector<float> want{0, 3, 6, 6, 9, 12};
  EXPECT_EQ(arc, want);
}

TEST(Fourier, OneHarmonicReproducesACircle) {
  std::vector<Vec2> circle;
  for (int i = 0; i < 720; ++i) {
    const det::SinCos a = det::sincos(det::kTwoPi * static_cast<float>(i) / 720);
    circle.push_back({50 + 30 * a.cos, 20 + 30 * a.sin});
  }
  const EllipticFourier f = fit(circle, 1);
  EXPECT_NEAR(f.a0, 50, 1e-3);
  EXPECT_NEAR(f.c0, 20, 1e-3);
  for (float t = 0; t < 1; t += 0.05f) EXPECT_NEAR(length(f.at(t) - Vec2{50, 20}), 30, 0.01f) << t;
}

TEST(Fourier, HarmonicsAreBounded) {
  const std::vector<Vec2> square{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  EXPECT_EQ(fit(square, 100).harmonics, kMaxHarmonics);
}

TEST(Fourier, PointsInOnePlaceAndCollinearPointsAreFinite) {
  const EllipticFourier point = fit(std::vector<Vec2>(20, Vec2{4, 4}), 5);
  EXPECT_EQ(length(point.at(0.3f)) - length(point.at(0.3f)), 0);
  std::vector<Vec2> line;
  for (int i = 0; i < 20; ++i) line.push_back({static_cast<float>(i < 10 ? i : 20 - i), 5});
  const EllipticFourier f = fit(line, 5);
  for (float t = 0; t < 1; t += 0.1f) EXPECT_NEAR(f.at(t).y, 5, 1e-4f);
  EXPECT_NEAR(f.at(0.5f).x, 10, 0.6f);
}

}  // namespace
}  // namespace nt
