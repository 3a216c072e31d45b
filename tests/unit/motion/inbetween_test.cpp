// SPDX-License-Identifier: Apache-2.0
#include "core/motion/inbetween.h"

#include <gtest/gtest.h>

#include "core/base/det_math.h"

namespace nt {
namespace {

TEST(InBetween, CentreGoesStraightAndTimeWithIt) {
  Motion a, b;
  a.time_ns = 1'000'000'000'000, b.time_ns = a.time_ns + 600;
  a.centre = {10, 20}, b.centre = {16, 8};
  for (int k = 0; k < kInBetweens; ++k) {
    const float t = in_between_fraction(k);
    const Motion m = in_between(a, b, t);
    EXPECT_NEAR(m.centre.x, 10 + 6 * t, 1e-5f);
    EXPECT_NEAR(m.centre.y, 20 - 12 * t, 1e-5f);
    EXPECT_NEAR(static_cast<double>(m.time_ns - a.time_ns), 100.0 * (k + 1), 1.0);
  }
}

TEST(InBetween, AnglesGoTheShortWayRound) {
  Motion a, b;
  a.dir_rad = 3.0f, b.dir_rad = -3.0f;  // 0.283 apart across pi
  a.l_fin_angle = -3.0f, b.l_fin_angle = 3.0f;
  a.low_axis_angle[14] = -1.5f, b.low_axis_angle[14] = -1.1f;
  const Motion m = in_between(a, b, 0.5f);
  EXPECT_NEAR(det::abs(det::wrap(m.dir_rad)), det::kPi, 1e-5f);
  EXPECT_NEAR(det::abs(det::wrap(m.l_fin_angle)), det::kPi, 1e-5f);
  EXPECT_NEAR(m.low_axis_angle[14], -1.3f, 1e-6f);
}

TEST(InBetween, EndsAreTheFrames) {
  Motion a, b;
  a.head_angle = 1.5f, b.head_angle = 1.7f;
  a.status = PoseStatus::ok, b.status = PoseStatus::partial;
  EXPECT_EQ(in_between(a, b, 0).head_angle, 1.5f);
  EXPECT_NEAR(in_between(a, b, 1).head_angle, 1.7f, 1e-6f);
  EXPECT_EQ(in_between(a, b, 0.3f).status, PoseStatus::ok);
  EXPECT_EQ(in_between(a, b, 0.7f).status, PoseStatus::partial);
}

TEST(InBetween, AFinThatAppearsOpensOnTheWay) {
  Motion a, b;
  a.r_fin_angle = kFoldedRightFin, a.confidence.r_fin = 0;
  b.r_fin_angle = 0, b.confidence.r_fin = 1;
  const Motion m = in_between(a, b, 0.5f);
  EXPECT_NEAR(m.r_fin_angle, kFoldedRightFin / 2, 1e-6f);
  EXPECT_NEAR(m.confidence.r_fin, 0.5f, 1e-6f);
}

TEST(InBetween, DifferentSamplingsDoNotMix) {
  Motion a, b;
  a.l_num = 15, b.l_num = 25;
  EXPECT_EQ(in_between(a, b, 0.4f).l_num, 15);
  EXPECT_EQ(in_between(a, b, 0.6f).l_num, 25);
}

}  // namespace
}  // namespace nt
