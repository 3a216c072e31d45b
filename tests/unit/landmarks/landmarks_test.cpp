// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/outline/stations.h"
#include "tests/support/fish_outline.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

using test::FishOutline;
using test::FishShape;

auto landmarks_for(const LandmarkSettings& settings = {}) {
  return test::Made([=](Arena& arena) { return Landmarks::create(arena, Limits{}, settings); });
}

FishPose pose_of(const std::vector<Vec2>& contour, const LandmarkHints& hints = {}) {
  auto landmarks = landmarks_for();
  FishPose pose;
  EXPECT_TRUE(landmarks->find(contour, hints, pose));
  return pose;
}

void expect_at(Vec2 a, Vec2 b, float tolerance, const char* what) {
  EXPECT_LT(length(a - b), tolerance) << what << ": " << a.x << "," << a.y << " for " << b.x << "," << b.y;
}

TEST(Landmarks, TheAxisOfABentFishIsWithinHalfAPercent) {
  for (const float bend : {-1.2f, -0.5f, 0.0f, 0.3f, 0.9f}) {
    for (const float heading : {0.0f, 1.0f, 2.5f, -2.0f}) {
      const FishOutline fish(FishShape{.bend = bend, .heading = heading});
      auto landmarks = landmarks_for();
      FishPose pose;
      ASSERT_TRUE(landmarks->find(fish.contour(), {}, pose));
      EXPECT_LT(fish.rms_from_axis(landmarks->midline()), 0.005f) << bend;
      EXPECT_NEAR(pose.axis_len, fish.axis_length(), 0.015f * fish.axis_length());
      expect_at(pose.head, fish.head(), 3, "head");
      expect_at(pose.tail, fish.tail(), 3, "tail");
      EXPECT_EQ(pose.confidence.l_fin, 0);
      EXPECT_EQ(pose.confidence.r_fin, 0);
    }
  }
}

TEST(Landmarks, FinsHardlyMoveTheAxisAndAreFoundOnTheirSide) {
  for (const float bend : {-0.8f, 0.0f, 0.5f}) {
    for (const int fins : {1, 2, 3}) {
      const FishOutline fish(FishShape{.bend = bend, .left_fin = (fins & 1) != 0, .right_fin = (fins & 2) != 0});
      auto landmarks = landmarks_for();
      FishPose pose;
      ASSERT_TRUE(landmarks->find(fish.contour(), {}, pose));
      EXPECT_LT(fish.rms_from_axis(landmarks->midline()), 0.01f) << bend << " " << fins;
      EXPECT_EQ(pose.confidence.l_fin > 0, (fins & 1) != 0) << bend;
      EXPECT_EQ(pose.confidence.r_fin > 0, (fins & 2) != 0) << bend;
      if ((fins & 1) != 0) {
        expect_at(pose.l_fin, fish.fin_tip(-1), 2, "left tip");
        expect_at(pose.jun_tl, fish.junction(-1, true), 8, "top left junction");
        expect_at(pose.jun_bl, fish.junction(-1, false), 8, "bottom left junction");
      }
      if ((fins & 2) != 0) {
        expect_at(pose.r_fin, fish.fin_tip(1), 2, "right tip");
        expect_at(pose.jun_tr, fish.junction(1, true), 8, "top right junction");
        expect_at(pose.jun_br, fish.junction(1, false), 8, "bottom right junction");
      }
    }
  }
}

TEST(Landmarks, AForkedTailEndsInItsNotch) {
  for (const float bend : {-0.6f, 0.0f, 0.6f}) {
    const FishOutline fish(FishShape{.bend = bend, .forked = true});
    const FishPose pose = pose_of(fish.contour());
    expect_at(pose.tail, fish.tail(), 4, "notch");
    expect_at(pose.head, fish.head(), 4, "head");
  }
}

TEST(Landmarks, TheSenseAndTheStartOfTheContourDoNotMatter) {
  const FishOutline fish(FishShape{.left_fin = true});
  const FishPose want = pose_of(fish.contour());
  std::vector<Vec2> reversed(fish.contour().rbegin(), fish.contour().rend());
  std::vector<Vec2> turned = fish.contour();
  std::rotate(turned.begin(), turned.begin() + 333, turned.end());
  for (const auto& contour : {reversed, turned}) {
    const FishPose pose = pose_of(contour);
    expect_at(pose.head, want.head, 0.1f, "head");
    expect_at(pose.tail, want.tail, 0.1f, "tail");
    expect_at(pose.centre, want.centre, 0.1f, "centre");
    expect_at(pose.l_fin, want.l_fin, 0.1f, "fin");
    EXPECT_EQ(pose.confidence.r_fin, 0);
    for (int i = 0; i < pose.l_num; ++i) expect_at(pose.low_axis[i], want.low_axis[i], 0.1f, "axis");
  }
}

TEST(Landmarks, AQuarterTurnAndAShiftCarryThePoseAlong) {
  const FishOutline fish(FishShape{.right_fin = true});
  const auto moved = [](Vec2 p) { return Vec2{700 - p.y, p.x + 40}; };
  std::vector<Vec2> contour;
  for (const Vec2 p : fish.contour()) contour.push_back(moved(p));
  const FishPose a = pose_of(fish.contour()), b = pose_of(contour);
  expect_at(b.head, moved(a.head), 0.1f, "head");
  expect_at(b.tail, moved(a.tail), 0.1f, "tail");
  expect_at(b.centre, moved(a.centre), 0.1f, "centre");
  expect_at(b.r_fin, moved(a.r_fin), 0.1f, "fin");
  expect_at(b.dir, {-a.dir.y, a.dir.x}, 1e-3f, "dir");
  EXPECT_NEAR(a.axis_len, b.axis_len, 0.1f);
}

TEST(Landmarks, ThePoseHoldsTogether) {
  auto landmarks = landmarks_for({5, 20, 8});
  const FishOutline fish(FishShape{});
  FishPose pose;
  ASSERT_TRUE(landmarks->find(fish.contour(), {}, pose));
  EXPECT_EQ(pose.u_num, 5);
  EXPECT_EQ(pose.l_num, 20);
  EXPECT_NEAR(length(pose.dir), 1, 1e-5f);
  EXPECT_GT(dot(pose.dir, pose.head - pose.tail), 0);
  // Samples run from the centre outwards in equal steps.
  std::vector<Vec2> walk{pose.head};
  for (int i = 4; i >= 0; --i) walk.push_back(pose.up_axis[i]);
  walk.push_back(pose.centre);
  for (int i = 0; i < 20; ++i) walk.push_back(pose.low_axis[i]);
  walk.push_back(pose.tail);
  float sum = 0;
  for (std::size_t i = 0; i + 1 < walk.size(); ++i) sum += length(walk[i + 1] - walk[i]);
  EXPECT_NEAR(sum, pose.axis_len, 0.01f * pose.axis_len);
  EXPECT_NEAR(landmarks->area_px(), 7250, 2000);
  EXPECT_EQ(landmarks->smooth_contour().size(), 2u * kStations);
}

TEST(Landmarks, OneContraryFrameDoesNotFlipTheFishButManyDo) {
  const FishOutline fish(FishShape{});
  auto landmarks = landmarks_for();
  FishPose pose;
  LandmarkHints hints;
  Vec2 last[] = {fish.tail(), fish.head()};
  hints.last = last;  // the wrong way round
  hints.head_log_odds = 3;
  ASSERT_TRUE(landmarks->find(fish.contour(), hints, pose));
  expect_at(pose.head, fish.tail(), 4, "the belief holds");
  EXPECT_FALSE(landmarks->swapped());
  EXPECT_LT(landmarks->head_log_odds(), 3);
  int frames = 1;
  for (; frames < 40 && !landmarks->swapped(); ++frames) {
    last[0] = pose.head, last[1] = pose.tail, hints.head_log_odds = landmarks->head_log_odds();
    ASSERT_TRUE(landmarks->find(fish.contour(), hints, pose));
  }
  EXPECT_LT(frames, 40);
  EXPECT_GT(frames, 3);
  expect_at(pose.head, fish.head(), 4, "the shape wins in the end");
}

TEST(Landmarks, WhatIsNoFishIsRefused) {
  auto landmarks = landmarks_for();
  FishPose pose;
  const FishOutline fish(FishShape{}), tiny(FishShape{.length = 6});
  EXPECT_FALSE(landmarks->find({}, {}, pose));
  EXPECT_FALSE(landmarks->find(std::span(fish.contour()).first(15), {}, pose)) << "under 16 points";
  EXPECT_FALSE(landmarks->find(tiny.contour(), {}, pose));
  const std::vector<Vec2> huge(static_cast<std::size_t>(Limits{}.max_contour_points) + 1, Vec2{1, 1});
  EXPECT_FALSE(landmarks->find(huge, {}, pose));
}

TEST(Landmarks, ALineWithoutAreaGivesNothingOrSomethingFinite) {
  std::vector<Vec2> line;
  for (int i = 0; i < 40; ++i) line.push_back({static_cast<float>(std::min(i, 40 - i)), 5});
  FishPose pose;
  if (landmarks_for()->find(line, {}, pose)) {
    for (const float v : {pose.axis_len, pose.head.x, pose.tail.y, pose.centre.x, pose.dir.x}) EXPECT_EQ(v - v, 0);
  }
}

TEST(Landmarks, RepeatedPointsDoNoHarm) {
  const FishOutline fish(FishShape{});
  std::vector<Vec2> twice;
  for (const Vec2 p : fish.contour()) twice.push_back(p), twice.push_back(p);
  const FishPose a = pose_of(fish.contour()), b = pose_of(twice);
  expect_at(a.head, b.head, 0.5f, "head");
  expect_at(a.tail, b.tail, 0.5f, "tail");
  expect_at(a.centre, b.centre, 0.5f, "centre");
}

TEST(Landmarks, EveryStatusHasAName) {
  for (const PoseStatus s : {PoseStatus::ok, PoseStatus::partial, PoseStatus::occluded, PoseStatus::absent,
                             PoseStatus::lost, PoseStatus::relearn})
    EXPECT_STRNE(to_string(s), "");
}

}  // namespace
}  // namespace nt
