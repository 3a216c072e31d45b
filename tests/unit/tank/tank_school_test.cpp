// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_school.h"

#include <gtest/gtest.h>

#include "platform/sim/tank.h"

namespace nt {
namespace {

TEST(TankSchool, ASceneWithoutCompanionsHasOneFish) {
  tank::School school(*find_tank_scene("calm"), 1, 320, 180);
  std::vector<tank::FishShape> fish;
  school.shape(fish);
  EXPECT_EQ(fish.size(), 1u);
  Tank tank({.width = 320, .height = 180});
  tank.render_next();
  EXPECT_TRUE(tank.truth().others.empty());
  EXPECT_FALSE(tank.truth().covered);
}

TEST(TankSchool, OneOfThreeFishPassesOverTheTargetAndLeavesItAgain) {
  for (uint64_t seed : {1, 2, 3}) {
    Tank tank({.scene = "crossing", .seed = seed, .width = 480, .height = 272});
    int passes = 0, covered = 0, apart = 0, all_visible = 0;
    float nearest = 1e9f;
    bool before = false;
    for (int frame = 0; frame < 900; ++frame) {
      tank.render_next();
      const TankTruth& truth = tank.truth();
      ASSERT_EQ(truth.others.size(), 2u);
      all_visible += truth.visible && truth.others[0].ok() && truth.others[1].ok();
      if (truth.visible && truth.others[0].ok())
        nearest = std::min(nearest, length(truth.others[0].centre - truth.pose.centre) / truth.pose.axis_len);
      passes += truth.covered && !before;
      covered += truth.covered;
      apart += truth.visible && !truth.covered;
      before = truth.covered;
    }
    EXPECT_GE(passes, 1) << seed;
    EXPECT_GE(covered, 20) << seed;
    EXPECT_GE(apart, 450) << seed;
    EXPECT_GE(all_visible, 450) << seed;
    EXPECT_LT(nearest, 0.35f) << seed;
  }
}

// The target is the fish that the scene would have without companions: they do not change its path.
TEST(TankSchool, TheTruthIsTheTargets) {
  TankScene alone = *find_tank_scene("crossing");
  alone.companions = 0;
  tank::School one(alone, 5, 480, 272), three(*find_tank_scene("crossing"), 5, 480, 272);
  std::vector<tank::FishShape> a, b;
  for (int frame = 0; frame < 400; ++frame) {
    one.advance(1.0 / 30);
    three.advance(1.0 / 30);
    one.shape(a);
    three.shape(b);
    ASSERT_EQ(b.size(), 3u);
    ASSERT_EQ(length(a[0].contour[0] - b[0].contour[0]), 0.0f) << frame;
    ASSERT_LT(b[1].length_px, b[0].length_px);
  }
}

TEST(TankSchool, OverlapSeesFishThatCrossAndOnesThatOnlyStandClose) {
  const tank::FishModel model(100.0f, CaudalFin::forked);
  const auto at = [&](Vec2 pivot, float heading_rad) {
    tank::Posture posture;
    posture.pivot = pivot;
    posture.heading_rad = heading_rad;
    posture.fin_rad[0] = posture.fin_rad[1] = tank::kFinFolded;
    tank::FishShape shape;
    model.shape(posture, shape);
    return shape;
  };
  const tank::FishShape fish = at({200, 200}, 0.0f);
  EXPECT_TRUE(tank::overlap(fish, at({200, 200}, 1.5f)));
  EXPECT_TRUE(tank::overlap(fish, at({200, 214}, 0.0f)));
  EXPECT_FALSE(tank::overlap(fish, at({200, 222}, 0.0f)));
  EXPECT_FALSE(tank::overlap(fish, at({400, 200}, 0.0f)));
  EXPECT_FALSE(tank::overlap(fish, at({165, 276}, 1.5708f)));  // boxes overlap, fish do not
}

}  // namespace
}  // namespace nt
