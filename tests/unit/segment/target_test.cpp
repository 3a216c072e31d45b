// SPDX-License-Identifier: Apache-2.0
#include "core/segment/target.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

// The blob of a filled ellipse that lies along x.
Blob ellipse(Vec2 centre, float rx, float ry) {
  Blob b;
  b.box = {static_cast<int>(centre.x - rx), static_cast<int>(centre.y - ry), static_cast<int>(centre.x + rx) + 1,
           static_cast<int>(centre.y + ry) + 1};
  b.area_px = static_cast<int>(det::kPi * rx * ry);
  b.centroid = centre;
  b.major_px = rx / 2, b.minor_px = ry / 2;
  return b;
}
Blob fish_at(float x, float y) { return ellipse({x, y}, 40, 10); }

using Scene = std::vector<Blob>;

TEST(Target, LikenessIsThatOfALongFilledWholeBlob) {
  const Blob fish = fish_at(100, 100);
  EXPECT_GT(fish_likeness(fish), 0.9f);
  EXPECT_LT(fish_likeness(ellipse({100, 100}, 20, 20)), 0.2f);
  Blob crack = fish, cut = fish, ghost = fish;
  crack.area_px /= 3, cut.touches_edge = true, ghost.ghost = true;
  EXPECT_LT(fish_likeness(crack), 0.2f);
  EXPECT_LT(fish_likeness(cut), 0.5f * fish_likeness(fish));
  EXPECT_EQ(fish_likeness(ghost), 0);
  Blob dot;
  dot.area_px = 1;
  EXPECT_GE(fish_likeness(dot), 0);
}

TEST(Target, NothingIsAbsent) {
  Target target;
  for (int n = 0; n < 50; ++n) {
    const TargetChoice choice = target.update({});
    EXPECT_EQ(choice.blob, -1);
    EXPECT_EQ(choice.status, PoseStatus::absent);
  }
}

TEST(Target, TheLargestFishShapedBlobIsTakenAtOnce) {
  Target target;
  const Scene scene{ellipse({50, 50}, 30, 8), fish_at(200, 80), ellipse({350, 150}, 45, 45)};
  const TargetChoice choice = target.update(scene);
  EXPECT_EQ(choice.blob, 1);
  EXPECT_EQ(choice.status, PoseStatus::ok);
  EXPECT_TRUE(target.changed());
  (void)target.update(scene);
  EXPECT_FALSE(target.changed());
}

TEST(Target, WhatSwimsIsPreferredToWhatRests) {
  Target target;
  int chosen = -1;
  for (int n = 0; n < 30; ++n) {
    const Scene scene{fish_at(100, 40), ellipse({100 + 5.0f * static_cast<float>(n), 150}, 34, 8)};
    chosen = target.update(scene).blob;
    if (n == 0) {
      EXPECT_EQ(chosen, 0) << "the larger one, while both rest";
    }
  }
  EXPECT_EQ(chosen, 1);
}

TEST(Target, KeepsItsFishWhileAnotherPassesNearby) {
  Target target;
  target.select_at({100, 100});
  for (int n = 0; n < 60; ++n) {
    const float x = 100 + 4.0f * static_cast<float>(n);
    const Scene scene{fish_at(420 - 4.0f * static_cast<float>(n), 130), fish_at(x, 100)};
    const TargetChoice choice = target.update(scene);
    ASSERT_EQ(choice.blob, 1) << n;
    (void)target.observe(scene[1].box, scene[1].centroid, static_cast<float>(scene[1].area_px), 100.0f);
  }
  EXPECT_NEAR(target.velocity().x, 4, 0.1f);
}

TEST(Target, IsLostForSoManyFramesAndThenStartsAnew) {
  Target target;
  target.set_lost_after(5);
  const Scene scene{fish_at(100, 100)};
  EXPECT_EQ(target.update(scene).blob, 0);
  for (int n = 1; n <= 6; ++n) {
    EXPECT_EQ(target.update({}).status, PoseStatus::lost) << n;
    EXPECT_EQ(target.lost_frames(), n);
  }
  EXPECT_EQ(target.update({}).status, PoseStatus::absent);
  const Scene elsewhere{fish_at(400, 300)};
  EXPECT_EQ(target.update(elsewhere).status, PoseStatus::ok) << "whatever swims in";
}

TEST(Target, ReturnsToItsFishAfterAShortGap) {
  Target target;
  const Scene scene{fish_at(100, 100)};
  (void)target.update(scene);
  for (int n = 0; n < 3; ++n) (void)target.update({});
  EXPECT_EQ(target.update(scene).blob, 0);
  EXPECT_FALSE(target.changed()) << "still the same fish";
  EXPECT_EQ(target.lost_frames(), 0);
}

TEST(Target, AClickSelectsTheBlobUnderIt) {
  Target target;
  const Scene scene{fish_at(100, 100), fish_at(300, 100), ellipse({300, 200}, 8, 8)};
  (void)target.update(scene);
  target.select_at({302, 203});
  EXPECT_EQ(target.update(scene).blob, 2);
  EXPECT_TRUE(target.changed());
  for (int n = 0; n < 40; ++n) EXPECT_EQ(target.update(scene).blob, 2) << "the user's choice stands";
  target.select_auto();
  EXPECT_NE(target.update(scene).blob, 2);
}

TEST(Target, AClickIntoAnEmptyPictureWaitsForABlob) {
  Target target;
  target.select_at({300, 100});
  EXPECT_EQ(target.update({}).blob, -1);
  const Scene scene{fish_at(100, 100), fish_at(300, 100)};
  EXPECT_EQ(target.update(scene).blob, 1);
}

TEST(Target, NextGoesRoundAllBlobs) {
  Target target;
  const Scene scene{fish_at(300, 50), fish_at(100, 120), fish_at(500, 90)};
  target.select_at({300, 50});
  EXPECT_EQ(target.update(scene).blob, 0);
  std::vector<int> order;
  for (int n = 0; n < 4; ++n) target.select_next(), order.push_back(target.update(scene).blob);
  EXPECT_EQ(order, (std::vector<int>{2, 1, 0, 2}));
}

TEST(Target, ABlobAtTheEdgeIsPartial) {
  Target target;
  Scene scene{fish_at(100, 100)};
  (void)target.update(scene);
  scene[0].touches_edge = true;
  EXPECT_EQ(target.update(scene).status, PoseStatus::partial);
}

TEST(Target, AGhostIsNeverTheFish) {
  Target target;
  Scene scene{fish_at(100, 100)};
  scene[0].ghost = true;
  EXPECT_EQ(target.update(scene).blob, -1);
}

TEST(Target, AnOutlineThatSuddenlyEnclosesMuchMoreIsAMergedOne) {
  Target target;
  target.set_lost_after(4);
  const Scene scene{fish_at(100, 100)};
  for (int n = 0; n < 5; ++n) {
    (void)target.update(scene);
    EXPECT_TRUE(target.observe(scene[0].box, scene[0].centroid, 1250, 100.0f));
  }
  (void)target.update(scene);
  EXPECT_TRUE(target.observe(scene[0].box, scene[0].centroid, 1600, 100.0f)) << "fins that opened";
  for (int n = 0; n < 4; ++n) {
    (void)target.update(scene);
    EXPECT_FALSE(target.observe(scene[0].box, scene[0].centroid, 2800, 100.0f));
  }
  (void)target.update(scene);
  EXPECT_TRUE(target.observe(scene[0].box, scene[0].centroid, 2800, 100.0f)) << "it stays so: this is the fish now";
  (void)target.update(scene);
  EXPECT_FALSE(target.observe(scene[0].box, scene[0].centroid, 2800, 50.0f)) << "half the axis: closed into a ring";
}

}  // namespace
}  // namespace nt
