// SPDX-License-Identifier: Apache-2.0
#include "app/author/rig.h"

#include <gtest/gtest.h>

#include <set>

#include "app/author/polyline.h"
#include "tests/app/straight_rig.h"

namespace nt {
namespace {

using test::expect_near;
using test::straight_rig;

TEST(Rig, EveryPointHasItsOwnNameAndTheNameLeadsBack) {
  std::set<std::string> seen;
  Rig rig = straight_rig(8, 32);
  for (RigFin& fin : rig.fins) fin.present = true;
  const std::vector<PointId> ids = points_of(rig);
  EXPECT_EQ(ids.size(), 3u + 8 + 32 + 4 * 3);
  for (const PointId id : ids) {
    EXPECT_TRUE(seen.insert(point_name(id)).second) << point_name(id);
    EXPECT_EQ(point_named(point_name(id)), id);
  }
  EXPECT_EQ(point_named("jun_bl_2"), (PointId{PointKind::fin_bottom, 2}));
  EXPECT_EQ(point_named("up_axis_9"), std::nullopt);
}

TEST(Rig, PointsThatAreNotThereAreNotListed) {
  Rig rig = straight_rig(3, 15);
  EXPECT_EQ(points_of(rig).size(), 3u + 18 + 6);
  EXPECT_FALSE(has_point(rig, {PointKind::up_axis, 3}));
  EXPECT_FALSE(has_point(rig, {PointKind::fin_tip, 2}));
  rig.fins[0] = {};
  EXPECT_FALSE(has_point(rig, *point_named("l_fin")));
  EXPECT_TRUE(has_point(rig, *point_named("r_fin")));
}

TEST(Rig, OtherNumbersKeepTheMidlineAndSpreadItsPointsEvenly) {
  Rig rig = straight_rig(3, 15);
  set_axis_numbers(rig, 5, 25);
  EXPECT_EQ(rig.u_num, 5);
  EXPECT_EQ(rig.l_num, 25);
  expect_near(rig.centre, {600, 300}, 0.01f);
  expect_near(rig.up_axis[0], {650, 300}, 0.01f);
  expect_near(rig.up_axis[4], {850, 300}, 0.01f);
  expect_near(rig.low_axis[12], {350, 300}, 0.01f);
  EXPECT_NEAR(midline_length(rig), 800, 0.01f);
}

TEST(Rig, ADrawnMidlineIsFollowed) {
  Rig rig = straight_rig(3, 15);
  const Vec2 line[] = {{900, 300}, {600, 320}, {600, 700}};
  lay_midline(rig, line);
  expect_near(rig.head, {900, 300}, 0);
  expect_near(rig.tail, {600, 700}, 0);
  EXPECT_NEAR(nearest_on_line(line, rig.low_axis[7], LineEnds::stop).at.y, rig.low_axis[7].y, 0.01f);
  EXPECT_NEAR(length(rig.centre - Vec2{600, 300}), 20, 1);  // the place on the line nearest to the old one
}

TEST(Rig, MirroringIsAcrossTheMidlineAlsoBeyondItsEndsAndWhereItBends) {
  Rig rig = straight_rig(3, 15);
  expect_near(mirrored(rig, {500, 200}), {500, 400}, 0.01f);
  expect_near(mirrored(rig, {950, 310}), {950, 290}, 0.01f);
  const Vec2 bent[] = {{900, 300}, {500, 300}, {500, 700}};
  lay_midline(rig, bent);
  expect_near(mirrored(rig, {450, 650}), {550, 650}, 0.5f);
}

TEST(Rig, SwappedEndsSwapSidesAndJunctionsAndTwiceIsAsBefore) {
  const Rig before = straight_rig(3, 15);
  Rig rig = before;
  swap_ends(rig);
  expect_near(rig.head, before.tail, 0);
  expect_near(rig.fins[0].tip, before.fins[1].tip, 0);
  expect_near(rig.fins[0].top, before.fins[1].bottom, 0);
  EXPECT_GT(rig.low_axis[14].x, rig.centre.x);
  swap_ends(rig);
  expect_near(rig.head, before.head, 0);
  expect_near(rig.centre, before.centre, 0.01f);
  expect_near(rig.low_axis[7], before.low_axis[7], 0.01f);
  expect_near(rig.fins[1].bottom, before.fins[1].bottom, 0);
}

TEST(Rig, AFinPlacedByItsTipIsRootedBetweenMidlineAndTip) {
  Rig rig = straight_rig(3, 15);
  place_fin(rig, 2, {400, 200});
  const RigFin& fin = rig.fins[2];
  ASSERT_TRUE(fin.present);
  EXPECT_GT(fin.top.x, fin.bottom.x);  // the head is at the right
  for (const Vec2 root : {fin.top, fin.bottom}) {
    EXPECT_LT(root.y, 300);
    EXPECT_GT(root.y, 200);
  }
}

TEST(Rig, AProposedFinMirrorsTheOtherSidesOrLiesOnItsOwn) {
  Rig rig = straight_rig(3, 15);
  rig.fins[1] = {};
  propose_fin(rig, 1);
  expect_near(rig.fins[1].tip, {500, 420}, 0.01f);
  rig.fins[0] = rig.fins[1] = {};
  propose_fin(rig, 0), propose_fin(rig, 1);
  EXPECT_LT(rig.fins[0].tip.y, 300);  // swims to the right: its left is up
  EXPECT_GT(rig.fins[1].tip.y, 300);
  EXPECT_LT(rig.fins[0].tip.x, rig.fins[0].top.x);  // swept back
  EXPECT_GT(rig.fins[0].top.x, rig.fins[0].bottom.x);
}

TEST(Polyline, OfOnePointAndWithoutLengthHoldsStill) {
  const Vec2 point[] = {{5, 5}};
  EXPECT_EQ(line_length(point), 0);
  expect_near(along_line(point, 3), {5, 5}, 0);
  expect_near(nearest_on_line(point, {9, 9}, LineEnds::go_on).at, {5, 5}, 0);
  const Vec2 still[] = {{5, 5}, {5, 5}};
  expect_near(along_line(still, 3), {5, 5}, 0);
  expect_near(nearest_on_line(still, {9, 9}, LineEnds::go_on).at, {5, 5}, 0);
}

TEST(Polyline, ARoundedLineGoesThroughItsPoints) {
  const std::vector<Vec2> line{{0, 0}, {10, 0}, {20, 10}};
  const std::vector<Vec2> curve = rounded_line(line);
  EXPECT_EQ(curve.size(), 17u);
  for (const Vec2 p : line) EXPECT_NEAR(length(nearest_on_line(curve, p, LineEnds::stop).at - p), 0, 1e-4f);
}

}  // namespace
}  // namespace nt
