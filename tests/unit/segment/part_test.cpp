// SPDX-License-Identifier: Apache-2.0
#include "core/segment/part.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/segment/clean.h"

namespace nt {
namespace {

constexpr int kWidth = 130, kHeight = 40, kWords = words_for(kWidth);
constexpr Box kBox{64, 10, 64 + kWidth, 10 + kHeight};

struct Masks {
  std::vector<uint64_t> words[4];
  std::vector<nt::Run> runs;
  BitMask fish;
  Masks() {
    for (auto& w : words) w.assign(static_cast<std::size_t>(kWords * kHeight), 0);
    fish = {words[0].data(), kWidth, kHeight, kWords};
  }
  // Of the mask, and where `label` >= 0 of that blob.
  void paint(int x0, int y0, int x1, int y1, int label) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) fish.set(x, y);
      if (label >= 0)
        runs.push_back({static_cast<int16_t>(y + kBox.y0), static_cast<int16_t>(x0 + kBox.x0),
                        static_cast<int16_t>(x1 + kBox.x0), label});
    }
  }
  void part(int mine, const std::vector<int>& others) {
    part_from_others(fish, kBox, runs, mine, others, words[1], words[2], words[3]);
  }
};

TEST(Part, WhatLiesBetweenGoesToTheNearerOne) {
  Masks masks;
  masks.paint(10, 10, 40, 20, 3);   // mine
  masks.paint(80, 10, 110, 20, 5);  // another's
  masks.paint(40, 14, 80, 16, -1);  // fins that touch, in no blob
  masks.part(3, {5});
  EXPECT_EQ(count_bits(masks.fish), 30 * 10 + 20 * 2);
  EXPECT_TRUE(masks.fish.at(59, 14));
  EXPECT_FALSE(masks.fish.at(60, 14));
  EXPECT_FALSE(masks.fish.at(90, 15));
}

TEST(Part, NearerIsAlongTheMask) {
  Masks masks;
  masks.paint(10, 5, 20, 35, 0);
  masks.paint(60, 5, 70, 35, 1);
  // A fin of the second one that ends close to the first, without touching it.
  masks.paint(23, 5, 60, 7, -1);
  masks.part(0, {1});
  EXPECT_EQ(count_bits(masks.fish), 10 * 30);
}

TEST(Part, WithoutOthersItIsWhatHangsTogetherWithTheBlob) {
  Masks masks;
  masks.paint(0, 0, 20, 20, 7);
  masks.paint(20, 0, 130, 2, -1);
  masks.paint(40, 30, 50, 40, -1);
  masks.part(7, {});
  EXPECT_EQ(count_bits(masks.fish), 20 * 20 + 110 * 2);
}

TEST(Part, RunsOutsideTheBoxAreNoMatter) {
  Masks masks;
  masks.paint(10, 10, 40, 20, 3);
  masks.runs.push_back({5, 64, 90, 3});
  masks.runs.push_back({45, 0, 400, 4});
  masks.part(3, {4});
  EXPECT_EQ(count_bits(masks.fish), 300);
}

}  // namespace
}  // namespace nt
