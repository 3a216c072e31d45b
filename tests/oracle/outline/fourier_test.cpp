// SPDX-License-Identifier: Apache-2.0
// Elliptic Fourier against [F] Eqs 2-6 written down directly in double with libm.
#include "core/outline/fourier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/fish_outline.h"

namespace {

using nt::Vec2;
constexpr double kPi = std::numbers::pi;

nt::EllipticFourier fit(const std::vector<Vec2>& contour, int harmonics) {
  std::vector<float> arc(contour.size() + 1);
  nt::arc_lengths(contour, arc);
  return nt::fit_fourier(contour, arc, harmonics);
}

struct Direct {
  double a0 = 0, c0 = 0;
  std::vector<double> a, b, c, d;
};

Direct direct(const std::vector<Vec2>& contour, int harmonics) {
  const std::size_t K = contour.size();
  std::vector<double> t(K + 1, 0), dx(K), dy(K), dt(K);
  for (std::size_t p = 0; p < K; ++p) {
    const Vec2 from = contour[p], to = contour[(p + 1) % K];
    dx[p] = static_cast<double>(to.x) - from.x, dy[p] = static_cast<double>(to.y) - from.y;
    dt[p] = std::hypot(dx[p], dy[p]);
    t[p + 1] = t[p] + dt[p];
  }
  const double T = t[K];
  Direct out;
  for (std::size_t p = 0; p < K; ++p) {
    out.a0 += (contour[p].x + dx[p] / 2) * dt[p] / T;
    out.c0 += (contour[p].y + dy[p] / 2) * dt[p] / T;
  }
  for (int n = 1; n <= harmonics; ++n) {
    const double scale = T / (2 * n * n * kPi * kPi);
    double a = 0, b = 0, c = 0, d = 0;
    for (std::size_t p = 0; p < K; ++p) {
      if (dt[p] == 0) continue;
      const double from = 2 * n * kPi * t[p] / T, to = 2 * n * kPi * t[p + 1] / T;
      a += dx[p] / dt[p] * (std::cos(to) - std::cos(from)), b += dx[p] / dt[p] * (std::sin(to) - std::sin(from));
      c += dy[p] / dt[p] * (std::cos(to) - std::cos(from)), d += dy[p] / dt[p] * (std::sin(to) - std::sin(from));
    }
    out.a.push_back(scale * a), out.b.push_back(scale * b), out.c.push_back(scale * c), out.d.push_back(scale * d);
  }
  return out;
}

TEST(FourierOracle, CoefficientsFromAnyStartPoint) {
  const nt::test::FishOutline fish({.left_fin = true, .forked = true});
  std::vector<Vec2> contour = fish.contour();
  contour.insert(contour.begin() + 50, contour[50]);  // a repeated point
  for (const int start : {0, 1, 77, 400}) {
    std::vector<Vec2> turned = contour;
    std::rotate(turned.begin(), turned.begin() + start, turned.end());
    for (const int harmonics : {1, 5, 16}) {
      const nt::EllipticFourier ours = fit(turned, harmonics);
      const Direct theirs = direct(turned, harmonics);
      EXPECT_NEAR(ours.a0, theirs.a0, 2e-3);
      EXPECT_NEAR(ours.c0, theirs.c0, 2e-3);
      for (int k = 0; k < harmonics; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        EXPECT_NEAR(ours.a[k], theirs.a[i], 5e-3) << k;
        EXPECT_NEAR(ours.b[k], theirs.b[i], 5e-3) << k;
        EXPECT_NEAR(ours.c[k], theirs.c[i], 5e-3) << k;
        EXPECT_NEAR(ours.d[k], theirs.d[i], 5e-3) << k;
      }
      for (double t = 0; t < 1; t += 0.037) {  // Eq 2
        double x = theirs.a0, y = theirs.c0;
        for (std::size_t i = 0; i < theirs.a.size(); ++i) {
          const double phi = 2 * kPi * static_cast<double>(i + 1) * t;
          x += theirs.a[i] * std::cos(phi) + theirs.b[i] * std::sin(phi);
          y += theirs.c[i] * std::cos(phi) + theirs.d[i] * std::sin(phi);
        }
        const Vec2 p = ours.at(static_cast<float>(t));
        EXPECT_NEAR(p.x, x, 0.02);
        EXPECT_NEAR(p.y, y, 0.02);
      }
    }
  }
}

// An ellipse is one harmonic of its own parameter; by arc length that holds the better the rounder it is.
TEST(FourierOracle, OneHarmonicIsNearlyAnEllipse) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    std::vector<Vec2> contour;
    for (int i = 0; i < 2000; ++i) {
      const double u = 50 * std::cos(2 * kPi * i / 2000), v = 40 * std::sin(2 * kPi * i / 2000);
      contour.push_back({static_cast<float>(200 + u * std::cos(angle) - v * std::sin(angle)),
                         static_cast<float>(150 + u * std::sin(angle) + v * std::cos(angle))});
    }
    const auto from_ellipse = [&](Vec2 p) {
      const double x = p.x - 200, y = p.y - 150;
      const double u = (x * std::cos(angle) + y * std::sin(angle)) / 50,
                   v = (y * std::cos(angle) - x * std::sin(angle)) / 40;
      return std::abs(std::hypot(u, v) - 1);
    };
    double one = 0, five = 0;
    for (float t = 0; t < 1; t += 0.01f) {
      one = std::max(one, from_ellipse(fit(contour, 1).at(t)));
      five = std::max(five, from_ellipse(fit(contour, 5).at(t)));
    }
    EXPECT_LT(one, 0.03);
    EXPECT_LT(five, 0.002);
  }
}

}  // namespace
