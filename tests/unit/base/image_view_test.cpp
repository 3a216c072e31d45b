// SPDX-License-Identifier: Apache-2.0
#include "core/base/image_view.h"

#include <gtest/gtest.h>

#include <vector>

namespace nt {
namespace {

TEST(ImageView, RowsFollowTheStride) {
  const std::vector<uint8_t> bytes = {1, 2, 3, 99, 4, 5, 6, 99};
  const LumaView view{bytes.data(), 3, 2, 4};
  EXPECT_EQ(view.row(1)[2], 6);
  EXPECT_FALSE(view.empty());
  EXPECT_TRUE((LumaView{bytes.data(), 0, 2, 4}).empty());
  EXPECT_TRUE(LumaView{}.empty());
}

TEST(BitMask, SetsOneBitAndNoOther) {
  constexpr int kWidth = 130, kHeight = 3;
  EXPECT_EQ(words_for(kWidth), 3);
  for (int x : {0, 1, 63, 64, 127, 128, 129}) {
    std::vector<uint64_t> words(static_cast<std::size_t>(words_for(kWidth)) * kHeight);
    BitMask mask{words.data(), kWidth, kHeight, words_for(kWidth)};
    mask.set(x, 1);
    for (int y = 0; y < kHeight; ++y)
      for (int u = 0; u < kWidth; ++u) ASSERT_EQ(mask.at(u, y), u == x && y == 1) << u << "," << y;
    EXPECT_EQ(mask.row(1)[x / 64], uint64_t{1} << (x % 64));
  }
}

TEST(BitMask, OutsideIsAlwaysClear) {
  std::vector<uint64_t> words(6, ~uint64_t{0});
  const BitMask mask{words.data(), 70, 3, 2};
  EXPECT_TRUE(mask.at(69, 2));
  EXPECT_FALSE(mask.at(70, 2));
  EXPECT_FALSE(mask.at(-1, 0));
  EXPECT_FALSE(mask.at(0, -1));
  EXPECT_FALSE(mask.at(0, 3));
}

TEST(BitMask, WordsRoundUp) {
  EXPECT_EQ(words_for(0), 0);
  EXPECT_EQ(words_for(1), 1);
  EXPECT_EQ(words_for(64), 1);
  EXPECT_EQ(words_for(65), 2);
}

void expect_box(const Box& got, const Box& want) {
  EXPECT_EQ(got.x0, want.x0);
  EXPECT_EQ(got.y0, want.y0);
  EXPECT_EQ(got.x1, want.x1);
  EXPECT_EQ(got.y1, want.y1);
}

TEST(Box, GrowsUpToTheFrame) {
  expect_box(grown({10, 20, 30, 40}, 5, 100, 100), {5, 15, 35, 45});
  expect_box(grown({2, 3, 98, 97}, 5, 100, 100), {0, 0, 100, 100});
  expect_box(grown({0, 0, 100, 50}, 0, 100, 50), {0, 0, 100, 50});
}

TEST(Box, EmptyWhereItHoldsNoPixel) {
  EXPECT_TRUE(Box{}.empty());
  EXPECT_TRUE((Box{5, 0, 5, 9}).empty());
  EXPECT_TRUE((Box{6, 0, 5, 9}).empty());
  EXPECT_FALSE((Box{5, 8, 6, 9}).empty());
  EXPECT_EQ((Box{2, 3, 7, 11}).width(), 5);
  EXPECT_EQ((Box{2, 3, 7, 11}).height(), 8);
}

}  // namespace
}  // namespace nt
