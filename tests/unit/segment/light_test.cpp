// SPDX-License-Identifier: Apache-2.0
#include "core/segment/light.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

Picture ground(float light, uint64_t seed = 5, float noise = 2.5f) {
  Picture p(160, 90);
  p.each([&](int x, int y, int) { return light * static_cast<float>(80 + (x * 7 + y * 5) % 40); });
  Random random(seed);
  return p.noise(random, noise);
}

TEST(LightFactor, ALampIsFoundInTheFrameInWhichItGoesOn) {
  for (const float lamp : {0.3f, 0.62f, 0.9f, 1.1f, 1.6f}) {
    Light light;
    light.start(ground(1.0f).luma());
    for (uint64_t n = 0; n < 5; ++n) {
      const Relight none = light.update(ground(1.0f, n).luma(), true);
      EXPECT_EQ(none.all, 1.0f);
      EXPECT_EQ(none.kept, 1.0f);
    }
    const Relight jump = light.update(ground(lamp, 77).luma(), true);
    EXPECT_NEAR(jump.all, lamp, 0.02f * lamp);
    EXPECT_EQ(jump.kept, 1.0f) << "all includes them";
    const Relight after = light.update(ground(lamp, 78).luma(), true);
    EXPECT_EQ(after.all, 1.0f) << lamp;
  }
}

TEST(LightFactor, SlowLightIsOnlyPassedOnToKeptPixels) {
  Light light;
  light.start(ground(1.0f).luma());
  float kept = 1.0f;
  for (int n = 1; n <= 600; ++n) {
    const float level = 1.0f + 0.15f * static_cast<float>(n) / 600;
    const Relight relight = light.update(ground(level, static_cast<uint64_t>(n)).luma(), true);
    EXPECT_EQ(relight.all, 1.0f) << n;
    kept *= relight.kept;
    EXPECT_NEAR(kept, level, 0.035f) << n;
  }
  EXPECT_NEAR(kept, 1.15f, 0.035f);
}

TEST(LightFactor, WithNothingKeptThereIsNoArrearsLater) {
  Light light;
  light.start(ground(1.0f).luma());
  for (int n = 1; n <= 600; ++n)
    (void)light.update(ground(1.0f + 0.2f * static_cast<float>(n) / 600, static_cast<uint64_t>(n)).luma(), false);
  EXPECT_EQ(light.update(ground(1.2f, 3).luma(), true).kept, 1.0f);
}

TEST(LightFactor, ABigFishIsNoLamp) {
  Light light;
  light.start(ground(1.0f).luma());
  Picture seen = ground(1.0f, 8);
  seen.paint({0, 0, 70, 90}, 220);
  EXPECT_EQ(light.update(seen.luma(), true).all, 1.0f);
}

TEST(LightFactor, TooDarkToTellChangesNothing) {
  Light light;
  light.start(Picture(160, 90, 4).luma());
  EXPECT_EQ(light.update(Picture(160, 90, 90).luma(), true).all, 1.0f);
}

TEST(LightFactor, ScaledPixelsAreRoundedAndStayBelow256) {
  uint8_t pixels[] = {0, 1, 100, 160, 200};
  scale_pixels(1.5f, pixels);
  EXPECT_EQ(pixels[0], 0);
  EXPECT_EQ(pixels[1], 2);
  EXPECT_EQ(pixels[2], 150);
  EXPECT_EQ(pixels[3], 240);
  EXPECT_EQ(pixels[4], 255);
  Picture plane(70, 2, 100);
  Bits where(70, 2);
  where.paint({60, 1, 70, 2});
  scale_pixels(0.5f, 0.5f, where.mask(), plane.view());
  for (int x = 0; x < 70; ++x) {
    EXPECT_EQ(plane.at(x, 0), 100);
    EXPECT_EQ(plane.at(x, 1), x < 60 ? 100 : 50) << x;
  }
}

}  // namespace
}  // namespace nt
