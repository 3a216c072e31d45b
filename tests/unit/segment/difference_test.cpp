// SPDX-License-Identifier: Apache-2.0
#include "core/segment/difference.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

constexpr int kWidths[] = {1, 7, 15, 17, 63, 64, 65, 127, 128, 130, 200};

// A background near the luma, so that every threshold has pixels on both sides and on it.
Picture near_to(const Picture& luma, Random& random, int stride) {
  Picture out(luma.width(), luma.height(), 0, stride);
  out.each([&](int x, int y, int) {
    return random.below(4) == 0 ? static_cast<int>(random.below(256))
                                : luma.at(x, y) + static_cast<int>(random.below(41)) - 20;
  });
  return out;
}

TEST(Difference, MaskMatchesThePlainLoop) {
  Random random(1);
  for (const int width : kWidths) {
    for (const int height : {1, 6}) {
      Picture luma(width, height);
      luma.scatter(random);
      const Picture background = near_to(luma, random, 0);
      for (const int threshold : {0, 1, 13, 60, 254, 255}) {
        for (const int sign : {-1, 0, 1}) {
          Bits mask(width, height);
          mask.soil();
          mask_of_difference(luma.luma(), background.luma(), threshold, sign, mask.mask());
          EXPECT_TRUE(test::clear_past_width(mask.mask()));
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              const int d = luma.at(x, y) - background.at(x, y);
              const int signed_d = sign == 0 ? std::abs(d) : sign * d;
              ASSERT_EQ(mask.mask().at(x, y), signed_d > threshold)
                  << width << " " << x << " " << threshold << " " << sign;
            }
          }
        }
      }
    }
  }
}

TEST(Difference, BothSignsInOnePassMatchThePlainLoop) {
  Random random(3);
  for (const int width : kWidths) {
    Picture luma(width, 3);
    luma.scatter(random);
    const Picture background = near_to(luma, random, 0);
    for (const int threshold : {0, 9, 255}) {
      Bits bright(width, 3), dark(width, 3);
      bright.soil(), dark.soil();
      masks_of_difference(luma.luma(), background.luma(), threshold, 0, bright.mask(), dark.mask());
      EXPECT_TRUE(test::clear_past_width(bright.mask()) && test::clear_past_width(dark.mask()));
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < width; ++x) {
          const int d = luma.at(x, y) - background.at(x, y);
          ASSERT_EQ(bright.mask().at(x, y), d > threshold) << width << " " << x;
          ASSERT_EQ(dark.mask().at(x, y), -d > threshold) << width << " " << x;
        }
      }
    }
  }
}

TEST(Difference, CopiesTheRunsOfOneBlobOnly) {
  const Picture luma(70, 3, 9);
  Picture plane(70, 3, 1);
  const nt::Run runs[] = {{0, 3, 5, 0}, {1, 60, 70, 1}, {2, 0, 1, -1}};
  copy_runs(luma.luma(), runs, 1, plane.view());
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 70; ++x) EXPECT_EQ(plane.at(x, y), y == 1 && x >= 60 ? 9 : 1);
}

int followed(int b, int v, FollowLimits limits) {
  const int up = v - b, down = b - v;
  if (up > limits.above && up <= limits.up_to) return b + 1;
  if (down > 0 && down <= limits.down_to) return b - 1;
  return b;
}

TEST(Difference, FollowingMatchesThePlainLoop) {
  Random random(2);
  const FollowLimits all[] = {{0, 0, 0}, {0, 10, 10}, {10, 255, 0}, {0, 255, 255}, {0, 0, 7}, {5, 9, 0}};
  for (const int width : kWidths) {
    Picture luma(width, 5);
    luma.scatter(random);
    Bits fore(width, 5), keep(width, 5);
    fore.scatter(random, 3), keep.scatter(random, 3);
    for (const FollowLimits limits : all) {
      for (const bool with_keep : {false, true}) {
        const int stride = static_cast<int>(align_up(static_cast<std::size_t>(width)));
        const Picture before = near_to(luma, random, stride);
        Picture after = before;
        follow_background(luma.luma(), fore.mask(), with_keep ? &keep.mask() : nullptr, limits, after.view());
        for (int y = 0; y < 5; ++y) {
          for (int x = 0; x < width; ++x) {
            const bool still = fore.mask().at(x, y) || (with_keep && keep.mask().at(x, y));
            const int want = still ? before.at(x, y) : followed(before.at(x, y), luma.at(x, y), limits);
            ASSERT_EQ(after.at(x, y), want) << width << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(Difference, TheScheduleIsQuickAtFirstAndThenHardlyDarkensForAShadow) {
  const int weak = 10;
  int small = 0, rising = 0, falling = 0;
  for (uint32_t frame = 0; frame < 32; ++frame) EXPECT_EQ(follow_limits(frame, weak).down_to, weak);
  for (uint32_t frame = 128; frame < 256; ++frame) {
    const FollowLimits limits = follow_limits(frame, weak);
    small += limits.above == 0 && limits.up_to > 0;
    rising += limits.up_to == 255;
    falling += limits.down_to == 255;
  }
  EXPECT_EQ(small, 9);
  EXPECT_EQ(rising, 17);
  EXPECT_EQ(falling, 1);
}

}  // namespace
}  // namespace nt
