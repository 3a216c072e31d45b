// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_fish.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nt::tank {
namespace {

constexpr float kLength = 220.0f;

FishShape shape_of(const Posture& posture, CaudalFin caudal = CaudalFin::forked) {
  FishShape shape;
  FishModel(kLength, caudal).shape(posture, shape);
  return shape;
}

Posture straight(float fin_rad = kFinFolded) {
  Posture p;
  p.pivot = {480, 272};
  p.fin_rad[kLeft] = p.fin_rad[kRight] = fin_rad;
  return p;
}

FishPose pose_of(const FishShape& shape) {
  FishPose pose;
  fill_pose(shape, 960, 544, pose);
  return pose;
}

TEST(TankFish, AStraightFishLiesAlongItsHeading) {
  const FishShape shape = shape_of(straight());
  const FishPose pose = pose_of(shape);
  EXPECT_EQ(pose.status, PoseStatus::ok);
  EXPECT_NEAR(pose.head.x - pose.tail.x, kLength, 0.01f);
  EXPECT_NEAR(pose.head.y, 272.0f, 1e-3f);
  EXPECT_NEAR(pose.dir.x, 1.0f, 1e-5f);
  EXPECT_NEAR(pose.centre.y, 272.0f, 1e-3f);
  EXPECT_GT(pose.centre.x, pose.tail.x + 0.5f * kLength);  // a fish is heavier in front
  // Right of a fish that heads right is down in the picture.
  EXPECT_GT(pose.jun_tr.y, 272.0f);
  EXPECT_LT(pose.jun_tl.y, 272.0f);
}

TEST(TankFish, TheMidlineKeepsItsLengthHoweverItBends) {
  for (float bend : {-2.4f, -0.7f, 0.0f, 1.5f, 2.4f}) {
    Posture p = straight();
    p.bend_rad = bend;
    p.wave_rad = 0.4f;
    p.wave_phase_rad = 1.0f;
    const FishShape shape = shape_of(p);
    float length_px = 0;
    for (std::size_t i = 1; i < shape.midline().size(); ++i)
      length_px += length(shape.midline()[i] - shape.midline()[i - 1]);
    EXPECT_NEAR(length_px, kLength, 0.01f);
  }
}

TEST(TankFish, APositiveBendTurnsTheHeadToTheRight) {
  Posture p = straight();
  p.bend_rad = 1.8f;
  const FishShape shape = shape_of(p);
  const auto line = shape.midline();
  const Vec2 front = line[0] - line[1], back = line[line.size() - 2] - line[line.size() - 1];
  EXPECT_NEAR(std::atan2(cross(back, front), dot(back, front)), 1.8f, 0.05f);
}

TEST(TankFish, AForkedTailEndsInItsNotchARoundedOneAtItsTip) {
  const auto farthest_back = [](const FishShape& shape) {
    float x = 1e9f;
    for (Vec2 p : shape.contour) x = std::fmin(x, p.x);
    return x;
  };
  const FishShape forked = shape_of(straight()), rounded = shape_of(straight(), CaudalFin::rounded);
  EXPECT_LT(farthest_back(forked), pose_of(forked).tail.x - 0.05f * kLength);
  EXPECT_NEAR(farthest_back(rounded), pose_of(rounded).tail.x, 1e-3f);
}

TEST(TankFish, FoldedFinsAreHiddenAndOpenOnesStandOut) {
  const FishShape folded = shape_of(straight()), open = shape_of(straight(kFinOpen));
  for (int side : {kLeft, kRight}) {
    EXPECT_TRUE(folded.fin[side].outside.empty());
    EXPECT_GT(open.fin[side].stands_out, 0.12f);
  }
  EXPECT_EQ(pose_of(folded).confidence.l_fin, 0.0f);
  const FishPose pose = pose_of(open);
  EXPECT_EQ(pose.confidence.l_fin, 1.0f);
  EXPECT_EQ(pose.confidence.r_fin, 1.0f);
  // Tips are the outline's farthest points from the (straight) midline.
  float left = 0, right = 0;
  for (Vec2 p : open.contour) {
    left = std::fmax(left, 272.0f - p.y);
    right = std::fmax(right, p.y - 272.0f);
  }
  EXPECT_NEAR(272.0f - pose.l_fin.y, left, 1e-3f);
  EXPECT_NEAR(pose.r_fin.y - 272.0f, right, 1e-3f);
  // Front junctions lie nearer to the head; all four lie on the body's outline.
  EXPECT_GT(pose.jun_tl.x, pose.jun_bl.x);
  EXPECT_GT(pose.jun_tr.x, pose.jun_br.x);
  for (Vec2 p : {pose.jun_tl, pose.jun_bl, pose.jun_tr, pose.jun_br})
    EXPECT_NEAR(std::fabs(p.y - 272.0f), body_half_width((pose.head.x - p.x) / kLength) * kLength, 0.05f);
}

TEST(TankFish, OpeningOneFinLeavesTheOtherFolded) {
  Posture p = straight();
  p.fin_rad[kRight] = kFinOpen;
  const FishPose pose = pose_of(shape_of(p));
  EXPECT_EQ(pose.confidence.l_fin, 0.0f);
  EXPECT_EQ(pose.confidence.r_fin, 1.0f);
}

TEST(TankFish, TheStatusTellsWhetherTheFrameCutsTheFish) {
  Posture p = straight();
  p.pivot = {40, 272};
  EXPECT_EQ(pose_of(shape_of(p)).status, PoseStatus::partial);
  EXPECT_EQ(pose_of(shape_of(p)).confidence.head, 0.0f);
  p.pivot = {-400, 272};
  EXPECT_EQ(pose_of(shape_of(p)).status, PoseStatus::absent);
}

TEST(TankFish, AxisSamplesStepEvenlyFromTheCentreToBothEnds) {
  Posture p = straight(kFinOpen);
  p.wave_rad = 0.3f;
  const FishPose pose = pose_of(shape_of(p));
  const auto even = [](Vec2 from, const Vec2* samples, int n, Vec2 to) {
    float shortest = 1e9f, longest = 0;
    Vec2 last = from;
    for (int i = 0; i <= n; ++i) {
      const Vec2 next = i < n ? samples[i] : to;
      shortest = std::fmin(shortest, length(next - last));
      longest = std::fmax(longest, length(next - last));
      last = next;
    }
    EXPECT_GT(shortest, 0.98f * longest);
  };
  even(pose.centre, pose.up_axis, pose.u_num, pose.head);
  even(pose.centre, pose.low_axis, pose.l_num, pose.tail);
}

}  // namespace
}  // namespace nt::tank
