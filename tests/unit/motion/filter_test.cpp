// SPDX-License-Identifier: Apache-2.0
#include "core/motion/filter.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"
#include "core/base/random.h"

namespace nt {
namespace {

constexpr float kDt = 1.0f / 30.0f;

float noise(Random& random) {  // sd 1
  float sum = 0;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum - 6.0f;
}

TEST(Kalman, FollowsConstantVelocityWithoutLag) {
  KalmanFilter f{KalmanParameters{}};
  for (int i = 0; i < 90; ++i) f.update(0.3f * kDt * static_cast<float>(i), kDt);
  EXPECT_NEAR(f.position(), 0.3f * kDt * 89, 1e-3f);
  EXPECT_NEAR(f.velocity(), 0.3f, 1e-2f);
}

TEST(Kalman, SmoothsNoiseOfAFishAtRest) {
  Random random(3);
  KalmanParameters parameters;
  parameters.acceleration_density = 0.1f;  // a calm fish: the gain must fall
  KalmanFilter f{parameters};
  double in = 0, out = 0;
  for (int i = 0; i < 2000; ++i) {
    const float measured = 0.005f * noise(random);
    const float filtered = f.update(measured, kDt);
    if (i < 100) continue;
    in += static_cast<double>(measured * measured);
    out += static_cast<double>(filtered * filtered);
  }
  EXPECT_LT(out, 0.6 * in);
}

TEST(Kalman, KeepsATailBeat) {
  KalmanFilter f{KalmanParameters{}};
  float most = 0;
  for (int i = 0; i < 360; ++i) {
    const float t = static_cast<float>(i) / 180.0f;
    const float v = f.update(0.1f * det::sin(det::kTwoPi * 3.0f * t), 1.0f / 180.0f);
    if (i > 180) most = det::max(most, v);
  }
  EXPECT_NEAR(most, 0.1f, 0.01f);
}

TEST(Kalman, StartsAgainAfterAGapAStandstillAndAReset) {
  KalmanFilter f{KalmanParameters{}};
  f.update(0, kDt);
  f.update(1, kDt);
  EXPECT_EQ(f.update(50, 1.0f), 50.0f);
  EXPECT_EQ(f.velocity(), 0.0f);
  EXPECT_EQ(f.update(60, 0.0f), 60.0f);
  EXPECT_EQ(f.update(70, -1.0f), 70.0f);
  f.update(71, kDt);
  f.reset();
  EXPECT_EQ(f.update(5, kDt), 5.0f);
}

TEST(Kalman, ABankIsManyFilters) {
  alignas(64) std::byte memory[4096];
  Arena arena(memory);
  KalmanBank bank;
  bank.create(arena, 3, KalmanParameters{});
  std::vector<KalmanFilter> one(3, KalmanFilter{KalmanParameters{}});
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    float values[3], expected[3];
    for (int k = 0; k < 3; ++k) values[k] = random.unit();
    for (std::size_t k = 0; k < 3; ++k) expected[k] = one[k].update(values[k], kDt);
    bank.update(values, kDt);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(values[k], expected[k]);
  }
}

TEST(Kalman, ScalesWithTheUnit) {
  KalmanFilter metre{KalmanParameters{}}, pixel{scaled(KalmanParameters{}, 400.0f)};
  Random random(9);
  for (int i = 0; i < 50; ++i) {
    const float v = random.unit();
    EXPECT_NEAR(metre.update(v, kDt) * 400.0f, pixel.update(v * 400.0f, kDt), 0.01f);
  }
}

}  // namespace
}  // namespace nt
