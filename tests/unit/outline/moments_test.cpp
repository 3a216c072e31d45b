// SPDX-License-Identifier: Apache-2.0
#include "core/outline/moments.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

TEST(Moments, OfARectangle) {
  const std::vector<Vec2> box{{10, 20}, {70, 20}, {70, 30}, {10, 30}};  // clockwise on the screen
  const Moments m = polygon_moments(box);
  EXPECT_FLOAT_EQ(m.area, 600);
  EXPECT_FLOAT_EQ(m.centroid.x, 40);
  EXPECT_FLOAT_EQ(m.centroid.y, 25);
  EXPECT_NEAR(det::abs(m.axis.x), 1, 1e-5f);
  EXPECT_NEAR(m.major, 60 / det::sqrt(12.0f), 1e-3f);
  EXPECT_NEAR(m.minor, 10 / det::sqrt(12.0f), 1e-3f);
}

TEST(Moments, TheSenseOnlyTurnsTheAreasSign) {
  const std::vector<Vec2> clockwise{{900, 500}, {960, 540}, {940, 560}, {905, 530}};
  const std::vector<Vec2> counter(clockwise.rbegin(), clockwise.rend());
  const Moments a = polygon_moments(clockwise), b = polygon_moments(counter);
  EXPECT_GT(a.area, 0);
  EXPECT_FLOAT_EQ(a.area, -b.area);
  EXPECT_NEAR(length(a.centroid - b.centroid), 0, 1e-3f);
  EXPECT_NEAR(a.major, b.major, 1e-3f);
  EXPECT_NEAR(a.minor, b.minor, 1e-3f);
  EXPECT_NEAR(det::abs(dot(a.axis, b.axis)), 1, 1e-5f);
}

TEST(Moments, WithoutAreaThereAreNone) {
  for (const auto& contour : {std::vector<Vec2>{}, std::vector<Vec2>{{1, 2}}, std::vector<Vec2>{{1, 2}, {3, 4}},
                              std::vector<Vec2>{{0, 0}, {2, 2}, {4, 4}, {2, 2}}, std::vector<Vec2>(9, Vec2{3, 3})}) {
    const Moments m = polygon_moments(contour);
    EXPECT_EQ(m.area, 0);
    EXPECT_EQ(m.major, 0);
    EXPECT_FLOAT_EQ(length(m.axis), 1) << "still a direction";
  }
}

TEST(Moments, APointLiesInsideOrNot) {
  // A C of straight pieces, open to the right.
  const std::vector<Vec2> c = {{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 8}, {10, 8}, {10, 10}, {0, 10}};
  for (const Vec2 in : {Vec2{1, 5}, Vec2{5, 1}, Vec2{9.5f, 9}}) EXPECT_TRUE(encloses(c, in));
  for (const Vec2 out : {Vec2{5, 5}, Vec2{-1, 5}, Vec2{11, 1}, Vec2{5, -1}, polygon_moments(c).centroid})
    EXPECT_FALSE(encloses(c, out));
  EXPECT_FALSE(encloses({}, {0, 0}));
}

}  // namespace
}  // namespace nt
