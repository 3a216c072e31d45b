// SPDX-License-Identifier: Apache-2.0
#include "core/segment/thin_tail.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/det_math.h"
#include "core/base/random.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

constexpr int kWidth = 256, kHeight = 96, kGround = 140;
constexpr float kSigma = 2.0f;
constexpr Box kAll{0, 0, kWidth, kHeight};

float tail_y(float x) { return 48.0f + 14.0f * det::sin(0.03f * (x - 60.0f)); }

// A noisy ground with a dark line `width` pixels wide along tail_y from x = 60 to `end`.
Picture filmed(float width, float contrast, float end, uint64_t seed) {
  Random random(seed);
  Picture p(kWidth, kHeight);
  p.each([&](int x, int y, int) {
    const float fx = static_cast<float>(x), off = det::abs(static_cast<float>(y) - tail_y(fx)) - 0.5f * width;
    const float covered = fx < 60.0f || fx > end ? 0.0f : det::clamp(0.5f - off, 0.0f, 1.0f);
    return kGround - contrast * covered;
  });
  return p.noise(random, kSigma);
}

float followed(const Picture& picture, const Bits& mask, float from_x) {
  Picture ground(kWidth, kHeight);
  ground.each([](int, int, int) { return kGround; });
  const Vec2 from{from_x, tail_y(from_x)}, next{from_x + 4.0f, tail_y(from_x + 4.0f)};
  return follow_thin_tail(picture.luma(), ground.luma(), kSigma, {from, normalised(next - from), 180.0f}, kAll,
                          mask.mask());
}

// Noise may hide it for so long that it seems to end: in one film of twenty it does.
TEST(ThinTail, IsFollowedRoundABendToItsEndThoughItsPixelsBarelyStandOut) {
  int reached = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Bits mask(kWidth, kHeight);
    followed(filmed(2.0f, 3.5f * kSigma, 170.0f, seed), mask, 80.0f);
    int last = 0, off = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (!mask.mask().at(x, y)) continue;
        last = std::max(last, x);
        off += det::abs(static_cast<float>(y) - tail_y(static_cast<float>(x))) > 3.0f;
      }
    }
    reached += last > 160;
    EXPECT_LE(last, 180) << seed;
    EXPECT_LE(off, 4) << seed;
  }
  EXPECT_GE(reached, 19);
}

TEST(ThinTail, ABroadTailGetsNothing) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Bits mask(kWidth, kHeight);
    EXPECT_EQ(followed(filmed(14.0f, 40.0f, 100.0f, seed), mask, 80.0f), 0.0f) << seed;
  }
}

TEST(ThinTail, NeitherDoesGroundWithoutATail) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const Bits mask(kWidth, kHeight);
    EXPECT_EQ(followed(filmed(2.0f, 0.0f, 60.0f, seed), mask, 80.0f), 0.0f) << seed;
  }
}

TEST(ThinTail, StopsAtTheFramesEdge) {
  const Bits mask(kWidth, kHeight);
  EXPECT_LE(followed(filmed(2.0f, 40.0f, 1000.0f, 1), mask, 200.0f), 56.0f);
}

}  // namespace
}  // namespace nt
