// SPDX-License-Identifier: Apache-2.0
// The error bounds that det_math.h promises, against the C library in long double.
#include "core/base/det_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nt {
namespace {

constexpr int kSteps = 400'000;

float at(float from, float to, int i) {
  return static_cast<float>(from + (static_cast<double>(to) - from) * i / kSteps);
}

template <class F>
double largest(float from, float to, F error) {
  double worst = 0;
  for (int i = 0; i <= kSteps; ++i) worst = std::max(worst, static_cast<double>(error(at(from, to, i))));
  return worst;
}

long double sincos_error(float a) {
  const det::SinCos got = det::sincos(a);
  return std::max(std::fabs(got.sin - std::sin(static_cast<long double>(a))),
                  std::fabs(got.cos - std::cos(static_cast<long double>(a))));
}

TEST(DetMath, SineAndCosine) {
  EXPECT_LT(largest(-8, 8, sincos_error), 2e-7);
  EXPECT_LT(largest(-1e4f, 1e4f, sincos_error), 2e-7);
  for (int quarter = -40; quarter <= 40; ++quarter) {  // where one polynomial hands over to the next
    const float edge = static_cast<float>(quarter) * det::kHalfPi / 2;
    for (float a : {std::nextafter(edge, -1e9f), edge, std::nextafter(edge, 1e9f)})
      EXPECT_LT(sincos_error(a), 2e-7) << a;
  }
  EXPECT_EQ(det::sin(0), 0.0f);
  EXPECT_EQ(det::cos(0), 1.0f);
}

TEST(DetMath, ArcTangentAllRound) {
  const auto error = [](float angle) {
    long double worst = 0;
    for (double r : {1e-30, 1e-3, 1.0, 7.3, 1e20}) {
      const auto y = static_cast<float>(r * std::sin(angle)), x = static_cast<float>(r * std::cos(angle));
      const long double want = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
      worst = std::max(worst, std::fabs(det::atan2(y, x) - want));
    }
    return worst;
  };
  EXPECT_LT(largest(-3.14159f, 3.14159f, error), 5e-7);
}

TEST(DetMath, ArcTangentOnTheAxes) {
  EXPECT_EQ(det::atan2(0, 0), 0.0f);
  EXPECT_EQ(det::atan2(0, 3), 0.0f);
  EXPECT_FLOAT_EQ(det::atan2(3, 0), det::kHalfPi);
  EXPECT_FLOAT_EQ(det::atan2(-3, 0), -det::kHalfPi);
  EXPECT_EQ(det::atan2(0, -3), det::kPi);  // the closed end of (-pi, pi]
  EXPECT_NEAR(det::atan2(-1e-30f, -3), -det::kPi, 5e-7);
  EXPECT_NEAR(det::atan2(2, 2), det::kPi / 4, 5e-7);
}

TEST(DetMath, Exponential) {
  const auto error = [](float v) {
    const long double want = std::exp(static_cast<long double>(v));
    return std::fabs(det::exp(v) - want) / want;
  };
  EXPECT_LT(largest(-80, 80, error), 3e-7);
  EXPECT_LT(largest(-1, 1, error), 3e-7);
  EXPECT_EQ(det::exp(0), 1.0f);
  EXPECT_EQ(det::exp(1000), det::exp(80));
  EXPECT_EQ(det::exp(-1000), det::exp(-80));
}

TEST(DetMath, Logarithm) {
  const auto error = [](float v) {
    const long double want = std::log(static_cast<long double>(v));
    return std::fabs(det::log(v) - want) / (1 + std::fabs(want));
  };
  EXPECT_LT(largest(1e-3f, 4, error), 1e-6);
  EXPECT_LT(largest(1, 1e6f, error), 1e-6);
  for (float v : {1e-45f, 1e-38f, 1e-20f, 0.5f, 1.0f, 2.0f, 1e20f, 3.4e38f}) EXPECT_LT(error(v), 1e-6) << v;
}

TEST(DetMath, WrapIsTheSameAngleWithinHalfATurn) {
  for (int i = 0; i <= kSteps; ++i) {
    const float a = at(-200, 200, i), w = det::wrap(a);
    ASSERT_GT(w, -det::kPi - 1e-6f) << a;
    ASSERT_LE(w, det::kPi) << a;
    ASSERT_NEAR(std::remainder(static_cast<double>(a) - w, 2 * 3.14159265358979323846), 0, 3e-7) << a;
  }
  EXPECT_EQ(det::wrap(0.25f), 0.25f);
  EXPECT_FLOAT_EQ(det::wrap(det::kTwoPi + 1), 1.0f);
  EXPECT_FLOAT_EQ(det::wrap(-4), det::kTwoPi - 4);
}

TEST(DetMath, UnwrapKeepsASequenceContinuous) {
  float followed = 0;
  for (int i = 1; i <= 4000; ++i) {
    const float truth = 0.01f * static_cast<float>(i);
    followed = det::unwrap(det::wrap(truth), followed);
    ASSERT_NEAR(followed, truth, 2e-5f) << i;
  }
  EXPECT_NEAR(det::unwrap(3, -3), 3 - det::kTwoPi, 1e-6);
  EXPECT_NEAR(det::unwrap(-3, 3), det::kTwoPi - 3, 1e-6);
  EXPECT_EQ(det::unwrap(1, 1.5f), 1.0f);
}

}  // namespace
}  // namespace nt
