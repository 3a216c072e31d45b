// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nt::tank {
namespace {

constexpr int kWidth = 960, kHeight = 544;

const TankScene& shaken() { return *find_tank_scene("shake"); }

TEST(TankHand, AStillCameraMovesNothing) {
  const Hand hand(*find_tank_scene("calm"), 1, kWidth, kHeight);
  EXPECT_TRUE(hand.still());
  EXPECT_EQ(Hand::margin_px(*find_tank_scene("calm"), kWidth, kHeight), 0);
  const Vec2 p = hand.frame_from_tank(3.0)({100, 200});
  EXPECT_EQ(p.x, 100.0f);
  EXPECT_EQ(p.y, 200.0f);
}

TEST(TankHand, TheInverseTakesEveryPointBack) {
  const Hand hand(shaken(), 2, kWidth, kHeight);
  for (double t : {0.0, 1.7, 12.3, 3600.0}) {
    const Similarity to = hand.frame_from_tank(t), back = to.inverse();
    for (Vec2 p : {Vec2{0, 0}, Vec2{959, 0}, Vec2{300, 543}}) EXPECT_LT(length(back(to(p)) - p), 1e-3f);
    EXPECT_NEAR(length(to({100, 0}) - to({0, 0})), 100.0f * to.scale, 1e-3f);
  }
}

TEST(TankHand, MovesSmoothlyWithinItsBoundsForHours) {
  const Hand hand(shaken(), 3, kWidth, kHeight);
  const auto margin = static_cast<float>(Hand::margin_px(shaken(), kWidth, kHeight));
  float shift = 0, turn = 0, scale = 0;
  for (double start : {0.0, 36000.0}) {
    Vec2 last[2];
    for (int frame = 0; frame < 1800; ++frame) {
      const Similarity to = hand.frame_from_tank(start + frame / 30.0), back = to.inverse();
      shift = std::max(shift, length(to.shift));
      turn = std::max(turn, std::fabs(to.sin));
      scale = std::max(scale, std::fabs(to.scale - 1.0f));
      const Vec2 corners[2] = {back({0, 0}), back({kWidth - 1, kHeight - 1})};
      EXPECT_GT(std::min(corners[0].x, corners[0].y), -margin);
      EXPECT_LT(corners[1].x, kWidth - 1 + margin);
      EXPECT_LT(corners[1].y, kHeight - 1 + margin);
      for (int i : {0, 1}) {
        if (frame > 0) {
          EXPECT_LT(length(corners[i] - last[i]), 8.0f);
        }
        last[i] = corners[i];
      }
    }
  }
  EXPECT_GT(shift, 0.01f * kWidth);
  EXPECT_LT(shift, 1.5f * shaken().shake_shift * kWidth);
  EXPECT_GT(turn, 0.01f);
  EXPECT_LT(turn, 1.04f * shaken().shake_rad);
  EXPECT_GT(scale, 0.01f);
  EXPECT_LE(scale, 1.001f * shaken().shake_scale);
}

TEST(TankHand, AMovedShapeKeepsItsForm) {
  FishShape shape;
  Posture posture;
  posture.pivot = {480, 272};
  posture.fin_rad[kLeft] = posture.fin_rad[kRight] = kFinOpen;
  FishModel(220.0f, CaudalFin::forked).shape(posture, shape);
  FishShape moved = shape;
  const Similarity to = Hand(shaken(), 4, kWidth, kHeight).frame_from_tank(5.0);
  ASSERT_GT(std::fabs(to.sin), 1e-3f);
  move_shape(to, moved);
  EXPECT_NEAR(moved.length_px, 220.0f * to.scale, 1e-3f);
  for (Vec2 n : moved.normal) EXPECT_NEAR(length(n), 1.0f, 1e-4f);
  // Body coordinates lead to the same points of the fish.
  for (float s : {0.0f, 0.4f, 1.0f})
    for (float n : {-0.05f, 0.0f, 0.05f}) EXPECT_LT(length(moved.at(s, n) - to(shape.at(s, n))), 0.01f);
  EXPECT_LT(length(moved.fin[kLeft].tip - to(shape.fin[kLeft].tip)), 1e-3f);
}

}  // namespace
}  // namespace nt::tank
