// SPDX-License-Identifier: Apache-2.0
#include "core/segment/still.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

auto still_for(int width, int height, int radius = 20) {
  return test::Made([=](Arena& arena) { return Still::create(arena, {BackgroundKind::still, radius}, width, height); });
}

TEST(Still, TheEstimateIsTheMedianOfWhatWasLearned) {
  for (const int pictures : {1, 2, 3, 19, 20, 23}) {
    const int width = 67, height = 5;
    auto still = still_for(width, height);
    Random random(static_cast<uint64_t>(pictures));
    std::vector<Picture> learned;
    for (int k = 0; k < pictures; ++k) {
      learned.emplace_back(width, height);
      still->learn(learned.back().scatter(random).luma());
    }
    Bits fore(width, height), all(width, height, true);
    EXPECT_TRUE(still->apply(Picture(width, height).luma(), &all.mask(), fore.mask()));  // kept: the plane stands still
    const std::size_t count = static_cast<std::size_t>(std::min(pictures, kLearnFrames));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::vector<uint8_t> values;
        for (std::size_t k = 0; k < count; ++k) values.push_back(learned[k].at(x, y));
        std::sort(values.begin(), values.end());
        ASSERT_EQ(still->estimate().row(y)[x], values[count / 2]) << pictures;
      }
    }
  }
}

TEST(Still, APictureOfAnotherSizeIsNotLearned) {
  auto still = still_for(40, 20);
  still->learn(Picture(39, 20, 200).luma());
  still->learn(Picture(40, 19, 200).luma());
  Bits fore(40, 20);
  EXPECT_FALSE(still->apply(Picture(40, 20, 50).luma(), nullptr, fore.mask())) << "nothing was learned";
  EXPECT_EQ(still->estimate().row(10)[10], 50);
}

TEST(Still, WithoutPicturesTheFirstFrameIsTheBackground) {
  auto still = still_for(70, 3);
  Bits fore(70, 3);
  fore.soil();
  EXPECT_FALSE(still->apply(Picture(70, 3, 90).luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 0);
  EXPECT_TRUE(test::clear_past_width(fore.mask()));
  Picture seen(70, 3, 90);
  seen.paint({64, 1, 70, 2}, 30);
  EXPECT_TRUE(still->apply(seen.luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 6);
  EXPECT_EQ(test::count_in(fore.mask(), {64, 1, 70, 2}), 6);
}

TEST(Still, FollowsSlowLightAndWhatTheFishHidesMovesAlong) {
  const int width = 100, height = 20;
  const Box fish{10, 5, 30, 15};
  auto still = still_for(width, height);
  Bits fore(width, height), keep(width, height);
  keep.paint(fish);
  (void)still->apply(Picture(width, height, 100).luma(), nullptr, fore.mask());
  for (int n = 0; n < 1200; ++n)
    (void)still->apply(Picture(width, height, 100 + n / 24).luma(), &keep.mask(), fore.mask());
  EXPECT_NEAR(still->estimate().row(10)[80], 149, 3);
  EXPECT_NEAR(still->estimate().row(10)[20], 149, 4) << "kept pixels are not learned, but lit";
  EXPECT_EQ(test::count_all(fore.mask()), 0);
  Picture seen(width, height, 149);
  for (int n = 0; n < 200; ++n) (void)still->apply(seen.paint(fish, 180).luma(), &keep.mask(), fore.mask());
  EXPECT_NEAR(still->estimate().row(10)[20], 149, 4);
  EXPECT_EQ(test::count_in(fore.mask(), fish), 200);
}

TEST(Still, APictureTakenInOtherLightWillDo) {
  auto still = still_for(100, 40);
  Picture ground(100, 40);
  ground.each([&](int x, int y, int) { return 60 + (x * 3 + y * 7) % 60; });
  still->learn(ground.luma());
  ground.each([](int, int, int v) { return static_cast<float>(v) * 1.5f; });
  Bits fore(100, 40);
  EXPECT_TRUE(still->apply(ground.luma(), nullptr, fore.mask()));
  EXPECT_TRUE(still->relit());
  EXPECT_EQ(test::count_all(fore.mask()), 0);
  EXPECT_TRUE(still->apply(ground.luma(), nullptr, fore.mask()));
  EXPECT_FALSE(still->relit());
}

TEST(Still, OnePixelAndRestart) {
  auto still = still_for(1, 1);
  Bits fore(1, 1);
  still->learn(Picture(1, 1, 10).luma());
  EXPECT_TRUE(still->apply(Picture(1, 1, 200).luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 1);
  still->restart();
  EXPECT_FALSE(still->apply(Picture(1, 1, 200).luma(), nullptr, fore.mask())) << "what was learned is forgotten too";
  EXPECT_EQ(test::count_all(fore.mask()), 0);
}

TEST(Still, TooLittleMemoryGivesNullHoweverLittle) {
  Arena measure;
  (void)Still::create(measure, {}, 64, 10);
  const test::Block block(measure.used());
  for (std::size_t bytes = 0; bytes < measure.used(); bytes += 64) {
    Arena arena(block.span().first(bytes));
    EXPECT_EQ(Still::create(arena, {}, 64, 10), nullptr) << bytes;
  }
}

}  // namespace
}  // namespace nt
