// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/shrink.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace {

TEST(Shrink, FactorsArePowersOfTwo) {
  EXPECT_EQ(nt::shrink_factor(64), 1);
  EXPECT_EQ(nt::shrink_factor(160), 1);
  EXPECT_EQ(nt::shrink_factor(161), 2);
  EXPECT_EQ(nt::shrink_factor(960), 8);
  EXPECT_EQ(nt::shrink_factor(8192), 16);
}

TEST(Shrink, IsTheMeanInSixteenths) {
  const int width = 203, height = 77;
  std::vector<uint8_t> luma(static_cast<std::size_t>(width * height));
  nt::Random random(3);
  for (uint8_t& p : luma) p = static_cast<uint8_t>(random.below(256));
  for (const int factor : {1, 2, 4, 8, 16}) {
    const int across = width / factor, down = height / factor;
    std::vector<uint16_t> columns(static_cast<std::size_t>(width)), small(static_cast<std::size_t>(across * down));
    nt::shrink({luma.data(), width, height, width}, factor, columns, {small.data(), across, down, across});
    for (int j = 0; j < down; ++j)
      for (int i = 0; i < across; ++i) {
        int sum = 0;
        for (int k = 0; k < factor * factor; ++k)
          sum += luma[static_cast<std::size_t>((j * factor + k / factor) * width + i * factor + k % factor)];
        ASSERT_EQ(small[static_cast<std::size_t>(j * across + i)], sum * 16 / (factor * factor)) << factor;
      }
  }
}

}  // namespace
