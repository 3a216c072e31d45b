// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/luma_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace nt {
namespace {

TEST(LumaRows, SpreadsLimitedRangeToWithinOne) {
  for (int y = 0; y < 256; ++y) {
    const double exact = std::clamp((y - 16) * 255.0 / 219.0, 0.0, 255.0);
    EXPECT_NEAR(spread_luma(static_cast<uint8_t>(y)), exact, 1.0) << y;
  }
  EXPECT_EQ(spread_luma(16), 0);
  EXPECT_EQ(spread_luma(235), 255);
}

TEST(LumaRows, LanesGiveThePlainBytesAtAnyWidth) {
  std::mt19937 random(3);
  for (int width = 1; width < 70; ++width) {
    const auto count = static_cast<std::size_t>(width);
    std::vector<uint8_t> yuyv(2 * count), grey(count), luma(count), spread(count), limited(count);
    for (uint8_t& byte : yuyv) byte = static_cast<uint8_t>(random());
    for (std::size_t x = 0; x < count; ++x) grey[x] = yuyv[2 * x];
    luma_from_yuyv(yuyv.data(), width, false, luma.data());
    EXPECT_EQ(luma, grey);
    luma_from_yuyv(yuyv.data(), width, true, spread.data());
    luma_from_limited(grey.data(), width, limited.data());
    for (std::size_t x = 0; x < count; ++x) {
      EXPECT_EQ(spread[x], spread_luma(grey[x])) << width << " " << x;
      EXPECT_EQ(limited[x], spread_luma(grey[x])) << width << " " << x;
    }
  }
}

}  // namespace
}  // namespace nt
