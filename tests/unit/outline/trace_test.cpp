// SPDX-License-Identifier: Apache-2.0
#include "core/outline/trace.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/outline/moments.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;

std::vector<Vec2> traced(const BitMask& mask, int origin_x = 0, int origin_y = 0) {
  std::vector<Vec2> out(5000);
  const int n = trace_outline(mask, origin_x, origin_y, out);
  EXPECT_GE(n, 0);
  out.resize(static_cast<std::size_t>(max_int(n, 0)));
  return out;
}

TEST(Trace, NothingAndOnePixel) {
  EXPECT_TRUE(traced(Bits(70, 5).mask()).empty());
  Bits one(70, 5);
  one.paint({66, 3, 67, 4});
  const auto contour = traced(one.mask(), 100, 200);
  ASSERT_EQ(contour.size(), 1u);
  EXPECT_EQ(contour[0].x, 166);
  EXPECT_EQ(contour[0].y, 203);
}

TEST(Trace, ARectangleOverTheWordsEdgeClockwise) {
  Bits mask(130, 20);
  mask.paint({60, 4, 70, 10});
  const auto contour = traced(mask.mask());
  EXPECT_EQ(contour.size(), 2u * (9 + 5));
  EXPECT_EQ(contour[0].x, 60);
  EXPECT_EQ(contour[0].y, 4);
  EXPECT_EQ(contour[1].x, 61);
  const Moments m = polygon_moments(contour);
  EXPECT_FLOAT_EQ(m.area, 45) << "positive: clockwise on the screen";
}

TEST(Trace, ALineIsWalkedOutAndBack) {
  Bits mask(20, 3);
  mask.paint({5, 1, 10, 2});
  EXPECT_EQ(traced(mask.mask()).size(), 8u);
}

TEST(Trace, AVIsWalkedDownAndUpAndBack) {
  Bits mask(5, 3);
  mask.mask().set(1, 0), mask.mask().set(2, 1), mask.mask().set(3, 0);
  const auto contour = traced(mask.mask());
  ASSERT_EQ(contour.size(), 4u);
  EXPECT_EQ(contour[1].y, 1);
  EXPECT_EQ(contour[2].x, 3);
  EXPECT_EQ(contour[3].y, 1);
}

TEST(Trace, FillingTheWholeMaskStaysInside) {
  for (const int width : {1, 2, 64, 65}) {
    Bits mask(width, 4, true);
    for (const Vec2 p : traced(mask.mask())) {
      EXPECT_TRUE(mask.mask().at(static_cast<int>(p.x), static_cast<int>(p.y)));
    }
  }
}

TEST(Trace, TooLittleRoomIsSaid) {
  Bits mask(20, 20);
  mask.paint({5, 5, 15, 15});
  std::vector<Vec2> out(36);
  EXPECT_EQ(trace_outline(mask.mask(), 0, 0, out), 36);
  EXPECT_EQ(trace_outline(mask.mask(), 0, 0, std::span(out).first(35)), -1);
  EXPECT_EQ(trace_outline(mask.mask(), 0, 0, {}), -1);
}

}  // namespace
}  // namespace nt
