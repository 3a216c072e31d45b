// SPDX-License-Identifier: Apache-2.0
#include "core/outline/smoother.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

StationValues constant(float v) {
  StationValues out;
  out.fill(v);
  return out;
}

StationValues slope() {
  StationValues out;
  for (std::size_t j = 0; j < kStations; ++j) out[j] = 3 + 0.5f * static_cast<float>(j);
  return out;
}

TEST(Smoother, AStraightLineStaysAsItIs) {
  for (const float lambda : {0.0f, 1.0f, 1000.0f}) {
    const StationValues out = smoothed(slope(), constant(1), lambda);
    for (std::size_t j = 0; j < kStations; ++j) EXPECT_NEAR(out[j], slope()[j], 1e-3f) << lambda;
  }
}

TEST(Smoother, AGapIsBridgedWhateverStandsInIt) {
  StationValues values = slope(), weights = constant(1);
  for (std::size_t j = 20; j < 35; ++j) values[j] = 1000, weights[j] = 0;
  const StationValues out = smoothed(values, weights, 2);
  for (std::size_t j = 0; j < kStations; ++j) EXPECT_NEAR(out[j], slope()[j], 1e-2f) << j;
}

TEST(Smoother, WithoutAnyWeightItIsFinite) {
  const StationValues out = smoothed(slope(), constant(0), 1);
  for (const float v : out) EXPECT_EQ(v - v, 0);
}

TEST(Smoother, StifferIsSmoother) {
  StationValues zigzag = constant(0);
  for (std::size_t j = 0; j < kStations; j += 2) zigzag[j] = 1;
  float last = 1;
  for (const float lambda : {0.1f, 1.0f, 10.0f}) {
    const StationValues out = smoothed(zigzag, constant(1), lambda);
    const float ripple = out[32] - out[33];
    EXPECT_LT(ripple, 0.7f * last);
    EXPECT_GT(ripple, 0);
    last = ripple;
  }
}

TEST(Smoother, TheLowerEnvelopeRunsUnderAPeak) {
  StationValues values = constant(10);
  for (std::size_t j = 25; j < 35; ++j) values[j] = 40;
  const StationValues foot = lower_envelope(values, 60);
  const StationValues mean = smoothed(values, constant(1), 60);
  for (std::size_t j = 0; j < kStations; ++j) EXPECT_NEAR(foot[j], 10, 1.5f) << j;
  EXPECT_GT(mean[30], 20) << "a plain smoother would not";
}

}  // namespace
}  // namespace nt
