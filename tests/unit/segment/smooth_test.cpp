// SPDX-License-Identifier: Apache-2.0
#include "core/segment/smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Picture;

int average(int a, int b) { return (a + b + 1) / 2; }
int blurred(int before, int here, int after) { return average(average(before, after), here); }

Picture plain(const Picture& from) {
  const int w = from.width(), h = from.height();
  Picture rows(w, h), out(w, h);
  rows.each([&](int x, int y, int) {
    return blurred(from.at(max_int(x - 1, 0), y), from.at(x, y), from.at(min_int(x + 1, w - 1), y));
  });
  out.each([&](int x, int y, int) {
    return blurred(rows.at(x, max_int(y - 1, 0)), rows.at(x, y), rows.at(x, min_int(y + 1, h - 1)));
  });
  return out;
}

TEST(Smooth, MatchesThePlainLoopBitForBit) {
  Random random(6);
  for (const int width : {1, 2, 3, 17, 18, 63, 64, 65, 66, 130, 512, 513, 600}) {
    for (const int height : {1, 2, 3, 20}) {
      Picture from(width, height);
      from.scatter(random);
      Picture out(width, height, 7, width + 5);
      blur_binomial(from.luma(), out.view());
      const Picture want = plain(from);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          ASSERT_EQ(out.at(x, y), want.at(x, y)) << width << "x" << height << " " << x << " " << y;
    }
  }
}

TEST(Smooth, LeavesLessThanHalfOfTheNoise) {
  Random random(7);
  Picture from(200, 200, 128), out(200, 200);
  blur_binomial(from.noise(random, 10).luma(), out.view());
  double sum = 0, sum_sq = 0;
  out.each([&](int, int, int v) { return sum += v, sum_sq += v * v, v; });
  const double mean = sum / 40000, sigma = std::sqrt(sum_sq / 40000 - mean * mean);
  EXPECT_NEAR(sigma, 3.75, 0.15);
  EXPECT_NEAR(mean, 128.75, 0.4) << "averages round up";
}

}  // namespace
}  // namespace nt
