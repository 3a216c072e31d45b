// SPDX-License-Identifier: Apache-2.0
#include "core/character/solid_pose.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/base/det_math.h"
#include "tests/support/block.h"

namespace nt {
namespace {

// A straight body from (0, 60) to (0, -100) with the centre at 0: u_num 1, l_num 2, and five vertices about it.
class SolidPoseTest : public ::testing::Test {
 protected:
  SolidPoseTest() {
    character_.u_num = 1, character_.l_num = 2;
    character_.vertices = vertices_, character_.heights = heights_, character_.normals = normals_;
    Arena measure;
    SolidPose none;
    none.create(measure, character_, body_);
    block_ = std::make_unique<test::Block>(2 * measure.used());
    arena_ = Arena(block_->span());
    solid_.create(arena_, character_, body_);
  }
  std::vector<Vec2> body_ = {{0, 0}, {0, 60}, {0, -100}, {0, 30}, {0, -33}, {0, -66}};
  std::vector<Vec2> vertices_ = {{5, 55}, {-5, 20}, {5, -10}, {-5, -50}, {5, -90}};
  std::vector<float> heights_ = {1, -2, 3, -4, 5};
  std::vector<Vec3> normals_ = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6f, 0, 0.8f}, {1, 0, 0}};
  Character character_;
  std::unique_ptr<test::Block> block_;
  Arena arena_;
  SolidPose solid_;
};

TEST_F(SolidPoseTest, AtRestHeightsScaleAndNormalsTurnIntoTheScene) {
  solid_.pose(body_, {2, 0});  // swims to the right of the picture, twice as large: the character's x is the scene's y
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    EXPECT_FLOAT_EQ(solid_.heights()[i], 2 * heights_[i]);
    const Vec3 n = normals_[i], now = solid_.normals()[i];
    EXPECT_NEAR(now.x, n.y, 1e-6f);
    EXPECT_NEAR(now.y, n.x, 1e-6f);
    EXPECT_NEAR(now.z, n.z, 1e-6f);
  }
}

TEST_F(SolidPoseTest, ANormalTurnsWithTheBoneBesideIt) {
  const float angle = 0.5f;
  const det::SinCos a = det::sincos(angle);
  std::vector<Vec2> bent = body_;
  bent[2] = bent[5] + Vec2{34 * a.sin, -34 * a.cos};  // the last bone turns anticlockwise
  solid_.pose(bent, {0, -1});                         // up the screen
  EXPECT_NEAR(solid_.normals()[0].x, 1, 1e-5f);       // at the head: as it was
  EXPECT_NEAR(solid_.normals()[0].y, 0, 1e-5f);
  EXPECT_NEAR(solid_.normals()[4].x, a.cos, 1e-2f);  // beside the last bone, beyond its middle
  EXPECT_NEAR(solid_.normals()[4].y, -a.sin, 1e-2f);
}

TEST_F(SolidPoseTest, ATwinHasItsOwnPose) {
  SolidPose twin;
  twin.twin(arena_, solid_);
  solid_.pose(body_, {0, -1});
  twin.pose(body_, {0, -3});
  EXPECT_FLOAT_EQ(solid_.heights()[4], 5);
  EXPECT_FLOAT_EQ(twin.heights()[4], 15);
}

TEST(SolidPose, AFlatCharacterNeedsNothing) {
  Character flat;
  Arena measure;
  SolidPose pose;
  pose.create(measure, flat, {});
  EXPECT_EQ(measure.used(), 0u);
  pose.pose({}, {0, -1});
  EXPECT_TRUE(pose.heights().empty());
}

}  // namespace
}  // namespace nt
