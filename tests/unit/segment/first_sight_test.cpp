// SPDX-License-Identifier: Apache-2.0
#include "core/segment/first_sight.h"

#include <gtest/gtest.h>

#include "core/segment/target.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

constexpr int kWidth = 320, kHeight = 180;

class FirstSightTest : public testing::Test {
 protected:
  int find(const Picture& p) { return sight_.find(p.luma(), 40, *blobs_, raw_.mask(), scratch_.mask(), fish_.mask()); }
  // The blobs of a picture whose ground is darker than 140, as a background model would give them.
  int lifeless(const Picture& p) {
    for (int y = 0; y < kHeight; ++y)
      for (int i = 0; i < raw_.mask().words_per_row; ++i) raw_.mask().row(y)[i] = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (p.at(x, y) > 140) raw_.mask().set(x, y);
    blobs_->find(raw_.mask(), 40);
    return sight_.lifeless(blobs_->blobs());
  }
  static Picture ground() {
    Picture p(kWidth, kHeight);
    Random random(6);
    p.each([&](int x, int y, int) { return 90 + x / 16 + static_cast<int>(random.below(16)) - y / 16; });
    return p;
  }
  static Picture with_fish(float x, float y, float half_length = 36) {
    return ground().ellipse(x, y, half_length, 9, 190);
  }

  FirstSight sight_;
  test::Made<Blobs* (*)(Arena&)> blobs_{[](Arena& arena) { return Blobs::create(arena, Limits{}); }};
  Bits raw_{kWidth, kHeight}, scratch_{kWidth, kHeight}, fish_{kWidth, kHeight};
};

TEST_F(FirstSightTest, AFishIsMarkedWithRoomForItsFins) {
  fish_.soil();
  EXPECT_EQ(find(with_fish(150, 90)), 1);
  int missing = 0;
  for (int y = 81; y < 99; ++y)
    for (int x = 116; x < 184; ++x) {
      const float u = (static_cast<float>(x) - 150) / 36, v = (static_cast<float>(y) - 90) / 9;
      missing += u * u + v * v <= 1 && !fish_.mask().at(x, y);
    }
  EXPECT_EQ(missing, 0);
  EXPECT_TRUE(fish_.mask().at(150, 76)) << "a fin that stands out";
  EXPECT_FALSE(fish_.mask().at(150, 40));
  EXPECT_FALSE(fish_.mask().at(60, 90));
}

TEST_F(FirstSightTest, ADarkFishOnBrightGroundToo) {
  Picture p = ground();
  p.each([](int, int, int v) { return 255 - v; });
  EXPECT_EQ(find(p.ellipse(150, 90, 36, 9, 60)), 1);
}

TEST_F(FirstSightTest, GroundBubblesAndWhatTheEdgeCutsAreNoFish) {
  EXPECT_EQ(find(ground()), 0);
  EXPECT_EQ(test::count_all(fish_.mask()), 0);
  EXPECT_EQ(find(ground().ellipse(150, 90, 14, 14, 190)), 0) << "round";
  EXPECT_EQ(find(with_fish(310, 90)), 0) << "cut by the edge";
  EXPECT_EQ(find(with_fish(150, 90, 150)), 1) << "long, but not a fifth of the frame";
  EXPECT_EQ(find(ground().ellipse(150, 90, 140, 60, 190)), 0) << "half of the frame";
}

TEST_F(FirstSightTest, EveryFishCountsUpToItsRoom) {
  Picture p = ground();
  for (int i = 0; i < 10; ++i)
    p.ellipse(60 + 60 * static_cast<float>(i % 4), 30 + 50 * static_cast<float>(i / 4), 20, 6, 190);
  EXPECT_EQ(find(p), FirstSight::kMostFish);
}

TEST_F(FirstSightTest, AStoneIsFoundOutOnceAndAFishNever) {
  ASSERT_EQ(find(with_fish(150, 90)), 1);
  int found = 0;
  for (int n = 0; n < 2 * FirstSight::kTrialFrames; ++n) {
    const bool told = lifeless(with_fish(150, 90)) == 0;
    EXPECT_TRUE(!told || n + 1 >= FirstSight::kTrialFrames);
    found += told;
    if (told) break;
  }
  EXPECT_EQ(found, 1);
  ASSERT_EQ(find(with_fish(150, 90)), 1);
  for (int n = 0; n < 2 * FirstSight::kTrialFrames; ++n)
    EXPECT_EQ(lifeless(with_fish(150 + static_cast<float>(n % 3), 90)), -1) << n;
}

}  // namespace
}  // namespace nt
