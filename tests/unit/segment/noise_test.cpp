// SPDX-License-Identifier: Apache-2.0
#include "core/segment/noise.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Picture;

TEST(Noise, IsThatOfAnOrdinaryCameraUntilTwoFramesWereSeen) {
  NoiseMeter meter;
  EXPECT_EQ(meter.sigma(), 2.5f);
  Random random(1);
  meter.add(Picture(80, 80, 100).noise(random, 9).luma());
  EXPECT_EQ(meter.sigma(), 2.5f);
  meter.add(Picture(80, 80, 100).noise(random, 9).luma());
  EXPECT_GT(meter.sigma(), 7.0f);
}

TEST(Noise, ARepeatedFrameSaysNothing) {
  Random random(2);
  NoiseMeter once, repeated;
  for (int n = 0; n < 10; ++n) {
    Picture seen(100, 70, 120);
    seen.noise(random, 5);
    once.add(seen.luma());
    for (int k = 0; k < 3; ++k) repeated.add(seen.luma());
  }
  EXPECT_EQ(once.sigma(), repeated.sigma());
}

TEST(Noise, AMovingFishHardlyCounts) {
  Random random(3);
  NoiseMeter empty, with_fish;
  for (int n = 0; n < 20; ++n) {
    Picture seen(160, 90, 120);
    seen.noise(random, 3);
    empty.add(seen.luma());
    with_fish.add(seen.ellipse(static_cast<float>(20 + 6 * n), 45, 30, 10, 30).luma());
  }
  EXPECT_NEAR(with_fish.sigma(), empty.sigma(), 0.12f * empty.sigma());
}

TEST(Noise, StopsListeningAfterTheFirstFramesAndRestartListensAgain) {
  Random random(4);
  NoiseMeter meter;
  for (int n = 0; n < 40; ++n) meter.add(Picture(80, 60, 100).noise(random, 2).luma());
  const float before = meter.sigma();
  for (int n = 0; n < 40; ++n) meter.add(Picture(80, 60, 100).noise(random, 12).luma());
  EXPECT_EQ(meter.sigma(), before);
  meter.restart();
  EXPECT_EQ(meter.sigma(), 2.5f);
  for (int n = 0; n < 40; ++n) meter.add(Picture(80, 60, 100).noise(random, 12).luma());
  EXPECT_NEAR(meter.sigma(), 12, 1);
}

TEST(Noise, OnePixelFrames) {
  NoiseMeter meter;
  for (int n = 0; n < 30; ++n) meter.add(Picture(1, 1, n % 2 == 0 ? 100 : 110).luma());
  EXPECT_NEAR(meter.sigma(), 10 / (0.6745f * 1.41421356f), 0.6f);
}

TEST(Noise, RadiusAndThresholdGrowWithTheNoiseWithinTheirBounds) {
  EXPECT_EQ(match_radius(2.5f), 20) << "the paper's value at an ordinary camera's noise";
  EXPECT_EQ(match_radius(0), 10);
  EXPECT_EQ(match_radius(1000), 48);
  EXPECT_EQ(weak_threshold(0), 6);
  EXPECT_EQ(weak_threshold(2.5f), 10);
  EXPECT_EQ(weak_threshold(1000), 60);
  for (float sigma = 0; sigma < 40; sigma += 0.25f) {
    EXPECT_LE(match_radius(sigma), match_radius(sigma + 0.25f));
    EXPECT_LE(weak_threshold(sigma), weak_threshold(sigma + 0.25f));
  }
}

}  // namespace
}  // namespace nt
