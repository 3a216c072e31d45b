// SPDX-License-Identifier: Apache-2.0
#include "core/segment/fill.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

// Ground of two greys left, two others right of a fish, which is what must not be left in the plane.
Picture ground_with_fish(int width, const Box& fish) {
  Picture p(width, 12);
  p.each([&](int x, int y, int) { return (x < fish.x0 ? 80 : 120) + (x + y) % 2; });
  return p.paint(fish, 250);
}

TEST(Fill, DrawnValuesAreThoseOfTheGroundBesideTheRunNearerSideMoreOften) {
  const Box fish{70, 3, 130, 9};
  Picture plane = ground_with_fish(200, fish);
  const Picture before = plane;
  Bits unknown(200, 12);
  unknown.paint(fish);
  Random random(3);
  fill_unknown(unknown.mask(), Fill::drawn, random, plane.view());
  std::set<int> seen;
  int low_left = 0, low_right = 0;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool inside = unknown.mask().at(x, y);
      if (!inside) {
        EXPECT_EQ(plane.at(x, y), before.at(x, y)) << x << " " << y;
        continue;
      }
      seen.insert(plane.at(x, y));
      const bool low = plane.at(x, y) < 100;
      low_left += low && x < 85, low_right += low && x >= 115;
    }
  }
  EXPECT_EQ(seen, (std::set<int>{80, 81, 120, 121}));
  EXPECT_GT(low_left, 3 * low_right);
  EXPECT_GT(low_right, 0);
}

TEST(Fill, TheMeanGoesEvenlyFromOneSideToTheOther) {
  const Box fish{64, 0, 128, 12};
  Picture plane = ground_with_fish(192, fish);
  Bits unknown(192, 12);
  unknown.paint(fish);
  Random random(3);
  fill_unknown(unknown.mask(), Fill::mean, random, plane.view());
  EXPECT_NEAR(plane.at(64, 5), 81, 1);
  EXPECT_NEAR(plane.at(96, 5), 101, 1);
  EXPECT_NEAR(plane.at(127, 5), 120, 1);
  for (int x = 65; x < 128; ++x) EXPECT_GE(plane.at(x, 5), plane.at(x - 1, 5));
}

TEST(Fill, AtTheEdgeOneSideMustDoAndWithoutGroundNothingHappens) {
  for (const Fill how : {Fill::drawn, Fill::mean}) {
    Picture plane(67, 3, 90);
    plane.paint({0, 0, 20, 1}, 250).paint({50, 1, 67, 2}, 250).paint({0, 2, 67, 3}, 250);
    Bits unknown(67, 3);
    unknown.paint({0, 0, 20, 1}).paint({50, 1, 67, 2}).paint({0, 2, 67, 3});
    Random random(1);
    fill_unknown(unknown.mask(), how, random, plane.view());
    for (int x = 0; x < 67; ++x) {
      EXPECT_EQ(plane.at(x, 0), 90) << x;
      EXPECT_EQ(plane.at(x, 1), 90) << x;
      EXPECT_EQ(plane.at(x, 2), 250) << x;
    }
  }
}

// What lies beyond another unknown run is ground too; that run itself is not.
TEST(Fill, AnotherFishBesideItIsNoGround) {
  Picture plane(120, 1, 90);
  plane.paint({40, 0, 60, 1}, 250).paint({64, 0, 80, 1}, 250);
  Bits unknown(120, 1);
  unknown.paint({40, 0, 60, 1}).paint({64, 0, 80, 1});
  Random random(1);
  fill_unknown(unknown.mask(), Fill::drawn, random, plane.view());
  for (int x = 0; x < 120; ++x) EXPECT_EQ(plane.at(x, 0), 90) << x;
}

}  // namespace
}  // namespace nt
