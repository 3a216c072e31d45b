// SPDX-License-Identifier: Apache-2.0
#include "app/author/corrections.h"

#include <gtest/gtest.h>

#include "app/author/polyline.h"
#include "platform/camera.h"
#include "tests/app/straight_rig.h"

namespace nt {
namespace {

using test::expect_near;
using test::straight_rig;

Corrections with(std::initializer_list<const char*> lines) {
  Corrections c;
  for (const char* line : lines) set_correction(c, "test", line);
  return c;
}

std::string refusal(const Rig& rig, const Corrections& c) {
  try {
    (void)corrected(rig, c);
  } catch (const UserError& e) {
    EXPECT_EQ(e.exit_code, 2);
    return e.what();
  }
  return "";
}

void expect_same(const Rig& a, const Rig& b, float tolerance) {
  ASSERT_EQ(points_of(a), points_of(b));
  for (const PointId p : points_of(a)) {
    SCOPED_TRACE(point_name(p));
    expect_near(point_at(a, p), point_at(b, p), tolerance);
    EXPECT_EQ(point_confidence(a, p), point_confidence(b, p));
  }
  EXPECT_EQ(a.flip, b.flip);
  EXPECT_EQ(a.deformer, b.deformer);
  EXPECT_EQ(a.harmonics, b.harmonics);
  EXPECT_EQ(a.has_tail_fin, b.has_tail_fin);
}

TEST(Corrections, NoneChangeNothing) { expect_same(corrected(straight_rig(), {}), straight_rig(), 0); }

TEST(Corrections, AMovedPointIsThereAndSureAndTheOthersStay) {
  const Rig rig = corrected(straight_rig(), with({"l_fin = 480,150", "head = 910,305"}));
  expect_near(rig.fins[0].tip, {480, 150}, 0);
  EXPECT_EQ(rig.fins[0].confidence, 1);
  expect_near(rig.head, {910, 305}, 0);
  EXPECT_EQ(rig.head_confidence, 1);
  expect_near(rig.fins[1].tip, {500, 420}, 0);
  EXPECT_FLOAT_EQ(rig.fins[1].confidence, 0.9f);
  expect_near(rig.tail, {100, 300}, 0);
}

TEST(Corrections, MirrorMovesTheOtherSideUnlessItHasItsOwn) {
  Rig rig = corrected(straight_rig(), with({"l_fin = 480,150", "mirror = yes"}));
  expect_near(rig.fins[1].tip, {480, 450}, 0.11f);
  rig = corrected(straight_rig(), with({"l_fin = 480,150", "r_fin = 470,500", "mirror = yes"}));
  expect_near(rig.fins[1].tip, {470, 500}, 0);
  rig = corrected(straight_rig(), with({"l_fin = 480,150", "r_fin = none", "mirror = yes"}));
  EXPECT_FALSE(rig.fins[1].present);
  rig = corrected(straight_rig(), with({"l_fin_2 = 300,200", "mirror = yes"}));  // makes both
  EXPECT_TRUE(rig.fins[2].present);
  expect_near(rig.fins[3].tip, {300, 400}, 0.11f);
}

TEST(Corrections, FinsAreRemovedAndProposedByPairs) {
  Rig rig = corrected(straight_rig(), with({"fins = 0"}));
  for (const RigFin& fin : rig.fins) EXPECT_FALSE(fin.present);
  rig = corrected(straight_rig(), with({"fins = 2"}));
  for (const RigFin& fin : rig.fins) EXPECT_TRUE(fin.present);
  expect_near(rig.fins[0].tip, {500, 180}, 0);  // was there
  rig = corrected(straight_rig(), with({"l_fin = none"}));
  EXPECT_FALSE(rig.fins[0].present);
  EXPECT_TRUE(rig.fins[1].present);
}

TEST(Corrections, TheHeadEndIsSaidByASideOrAPlace) {
  for (const char* said : {"head_end = left", "head_end = 120,310"}) {
    const Rig rig = corrected(straight_rig(), with({said}));
    expect_near(rig.head, {100, 300}, 0);
    EXPECT_EQ(rig.head_confidence, 1);
  }
  for (const char* said : {"head_end = right", "head_end = 820,310"})
    expect_near(corrected(straight_rig(), with({said})).head, {900, 300}, 0);
}

TEST(Corrections, AMidlineThenPointsOnIt) {
  const Corrections c = with({"midline = 900,300 600,320 600,700", "u_num = 2", "tail = 610,710"});
  const Rig rig = corrected(straight_rig(), c);
  EXPECT_EQ(rig.u_num, 2);
  expect_near(rig.tail, {610, 710}, 0);
  EXPECT_LT(length(nearest_on_line(c.midline, rig.low_axis[10], LineEnds::stop).at - rig.low_axis[10]), 0.01f);
}

TEST(Corrections, AppliedAgainChangeNothing) {
  const Corrections c =
      with({"head_end = left", "u_num = 5", "l_num = 20", "harmonics = 8", "midline = 90,300 500,330 880,290",
            "fins = 2", "r_fin_2 = none", "l_fin = 300,500", "low_axis_3 = 700,320", "mirror = yes", "flip = yes",
            "tail_fin = no", "deformer = affine"});
  const Rig once = corrected(straight_rig(), c);
  expect_same(corrected(once, c), once, 0.02f);
}

TEST(Corrections, WhatDoesNotGoTogetherIsRefusedInOneLine) {
  EXPECT_EQ(refusal(straight_rig(), with({"low_axis_20 = 5,5"})),
            "corrections: there is no low_axis_20; the character has u_num 3 and l_num 15");
  EXPECT_EQ(refusal(straight_rig(), with({"jun_tl_2 = 5,5"})),
            "corrections: there is no jun_tl_2; this fin needs its tip, l_fin_2, too");
  EXPECT_EQ(refusal(straight_rig(), with({"up_axis_1 = 600,300"})),
            "corrections: two neighbouring points of the midline lie on each other; move them apart");
  EXPECT_EQ(refusal(straight_rig(), with({"low_axis_20 = 5,5", "l_num = 20"})), "");
}

}  // namespace
}  // namespace nt
