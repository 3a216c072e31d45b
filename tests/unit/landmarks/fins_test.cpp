// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/fins.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/fish_outline.h"

namespace nt {
namespace {

using test::FishOutline;
using test::FishShape;

// Everything that find_fin takes, from a contour and its true axis.
struct Scene {
  Scene(const std::vector<Vec2>& points, const FishOutline& fish) : contour(points), along(points.size()) {
    std::vector<Vec2> line;
    for (int i = 0; i <= 200; ++i) line.push_back(fish.at(static_cast<float>(i) / 200, 0));
    axis = resampled(line);
    int tail = 0;
    for (int i = 0; i < static_cast<int>(contour.size()); ++i)
      if (length(at(i) - fish.tail()) < length(at(tail) - fish.tail())) tail = i;
    right = {0, tail};
    project_outline(contour, right, axis, along);
    body = body_half_width(width_profile(along, right));
  }
  Vec2 at(int i) const { return contour[static_cast<std::size_t>(i)]; }
  Fin find(Side side) const { return find_fin(contour, along, right, body, axis.length, side); }
  std::vector<Vec2> contour;
  std::vector<AlongAxis> along;
  Axis axis;
  Stretch right;
  StationValues body;
};

TEST(Fins, AnOpenFinIsSeenOnItsOwnSide) {
  for (const float bend : {-0.7f, 0.0f, 0.7f}) {
    const FishOutline fish(FishShape{.bend = bend, .left_fin = true});
    const Scene scene(fish.contour(), fish);
    const Fin left = scene.find(Side::left), right = scene.find(Side::right);
    EXPECT_TRUE(left.seen);
    EXPECT_FALSE(right.seen);
    EXPECT_GT(left.confidence, 0.9f);
    EXPECT_EQ(right.confidence, 0);
    EXPECT_LT(length(scene.at(left.tip) - fish.fin_tip(-1)), 2);
    EXPECT_LT(length(scene.at(left.top) - fish.junction(-1, true)), 8);
    EXPECT_LT(length(scene.at(left.bottom) - fish.junction(-1, false)), 8);
  }
}

TEST(Fins, TheJunctionsOfStraightAndOfHollowEdgesAreAtTheBody) {
  for (const float bulge : {0.06f, 0.0f, -0.06f}) {
    const FishOutline fish(FishShape{.bend = 0, .right_fin = true, .fin_bulge = bulge});
    const Scene scene(fish.contour(), fish);
    const Fin fin = scene.find(Side::right);
    ASSERT_TRUE(fin.seen) << bulge;
    EXPECT_LT(length(scene.at(fin.top) - fish.junction(1, true)), 8) << bulge;
    EXPECT_LT(length(scene.at(fin.bottom) - fish.junction(1, false)), 8) << bulge;
  }
}

TEST(Fins, ALarvasSwimBladderIsNoFin) {
  const FishOutline larva(FishShape{.length = 90, .bend = 0.2f, .larva = true});
  const Scene scene(larva.contour(), larva);
  EXPECT_FALSE(scene.find(Side::left).seen);
  EXPECT_FALSE(scene.find(Side::right).seen);
}

TEST(Fins, AFoldedFinIsNotSeen) {
  const FishOutline fish(FishShape{});
  const Scene scene(fish.contour(), fish);
  for (const Side side : {Side::left, Side::right}) {
    EXPECT_FALSE(scene.find(side).seen);
    EXPECT_EQ(scene.find(side).confidence, 0);
  }
}

TEST(Fins, ASpurOfNoiseIsNoFin) {
  const FishOutline fish(FishShape{.bend = 0});
  std::vector<Vec2> contour = fish.contour();
  const Vec2 out = right_of(normalised(fish.head() - fish.tail()));
  std::size_t at = 0;
  for (std::size_t i = 0; i < contour.size(); ++i)
    if (length(contour[i] - fish.at(0.35f, fish.half_width(0.35f))) <
        length(contour[at] - fish.at(0.35f, fish.half_width(0.35f))))
      at = i;
  contour[at] += out * 20;  // far enough out, but one pixel wide
  EXPECT_FALSE(Scene(contour, fish).find(Side::right).seen);
}

TEST(Fins, ASideWithoutPointsHasNone) {
  const FishOutline fish(FishShape{});
  Scene scene(fish.contour(), fish);
  scene.right = {0, 0};
  EXPECT_FALSE(scene.find(Side::right).seen);
}

}  // namespace
}  // namespace nt
