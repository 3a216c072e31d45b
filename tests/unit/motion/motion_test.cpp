// SPDX-License-Identifier: Apache-2.0
#include "core/motion/motion.h"

#include <gtest/gtest.h>

#include "core/base/det_math.h"

namespace nt {
namespace {

// A straight fish at `centre` swimming along `angle` (image coordinates), fins straight out.
FishPose straight_fish(Vec2 centre, float angle) {
  FishPose p;
  p.status = PoseStatus::ok;
  const det::SinCos a = det::sincos(angle);
  p.dir = {a.cos, a.sin};
  const Vec2 right = right_of(p.dir);
  p.centre = centre;
  for (int i = 0; i < p.u_num; ++i) p.up_axis[i] = centre + p.dir * (10.0f * static_cast<float>(i + 1));
  for (int i = 0; i < p.l_num; ++i) p.low_axis[i] = centre - p.dir * (5.0f * static_cast<float>(i + 1));
  p.head = centre + p.dir * 40.0f;
  p.tail = centre - p.dir * 80.0f;
  p.jun_tl = centre - right * 10.0f, p.jun_tr = centre + right * 10.0f;
  p.l_fin = centre - right * 30.0f, p.r_fin = centre + right * 30.0f;
  p.confidence = {1, 1, 1, 1, 1, 1};
  return p;
}

TEST(Motion, AStraightFishHasUpperAnglesAtHalfPiAndLowerOnesAtMinusHalfPi) {
  for (float angle = -3.0f; angle < 3.0f; angle += 0.37f) {
    const Motion m = motion_from_pose(straight_fish({100, 50}, angle), 7, nullptr);
    EXPECT_EQ(m.time_ns, 7);
    EXPECT_EQ(m.centre.x, 100.0f);
    EXPECT_NEAR(m.dir_rad, angle, 1e-5f);
    for (int i = 0; i < m.u_num; ++i) EXPECT_NEAR(m.up_axis_angle[i], det::kHalfPi, 1e-5f);
    for (int i = 0; i < m.l_num; ++i) EXPECT_NEAR(m.low_axis_angle[i], -det::kHalfPi, 1e-5f);
    EXPECT_NEAR(m.head_angle, det::kHalfPi, 1e-5f);
    EXPECT_NEAR(m.tail_angle, -det::kHalfPi, 1e-5f);
    EXPECT_NEAR(m.r_fin_angle, 0.0f, 1e-5f);
    EXPECT_NEAR(det::abs(m.l_fin_angle), det::kPi, 1e-5f);
  }
}

TEST(Motion, ATailSwungToTheRightTurnsItsAngleTowardsZero) {
  FishPose p = straight_fish({0, 0}, 0);  // swims to the right of the picture: its right is down
  p.tail.y += 5.0f;
  EXPECT_GT(motion_from_pose(p, 0, nullptr).tail_angle, -det::kHalfPi + 0.1f);
}

TEST(Motion, DirectionIsContinuousOverManyTurns) {
  Motion last = motion_from_pose(straight_fish({0, 0}, 0), 0, nullptr);
  for (int i = 1; i <= 100; ++i) {
    const float angle = 0.3f * static_cast<float>(i);
    last = motion_from_pose(straight_fish({0, 0}, det::wrap(angle)), i, &last);
    ASSERT_NEAR(last.dir_rad, angle, 1e-3f);
  }
}

TEST(Motion, AFinThatBeatsAcrossMinusPiDoesNotJump) {
  FishPose p = straight_fish({0, 0}, -det::kHalfPi);  // up the screen: left is left
  Motion last = motion_from_pose(p, 0, nullptr);
  for (int i = 0; i < 20; ++i) {
    p.l_fin = p.jun_tl + Vec2{-20.0f, i % 2 == 0 ? 4.0f : -4.0f};
    const Motion m = motion_from_pose(p, i, &last);
    EXPECT_LT(det::abs(m.l_fin_angle - last.l_fin_angle), 0.5f);
    last = m;
  }
}

TEST(Motion, AFinNotSeenIsFoldedWithConfidenceZero) {
  FishPose p = straight_fish({0, 0}, 0.4f);
  p.confidence.l_fin = 0;
  p.confidence.r_fin = 0;
  const Motion m = motion_from_pose(p, 0, nullptr);
  EXPECT_EQ(m.l_fin_angle, kFoldedLeftFin);
  EXPECT_EQ(m.r_fin_angle, kFoldedRightFin);
  EXPECT_EQ(m.confidence.l_fin, 0.0f);
}

}  // namespace
}  // namespace nt
