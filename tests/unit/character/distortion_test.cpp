// SPDX-License-Identifier: Apache-2.0
#include "core/character/distortion.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/base/det_math.h"
#include "tests/support/block.h"
#include "tests/support/drawn_character.h"

namespace nt {
namespace {

class DistortionTest : public ::testing::Test {
 protected:
  DistortionTest() : character_(open_character(drawn_.bytes(), Limits{}).value()) {
    Arena measure;
    EXPECT_EQ(DistortionMeter::create(measure, character_), nullptr);
    block_ = std::make_unique<test::Block>(measure.used());
    Arena arena(block_->span());
    meter_ = DistortionMeter::create(arena, character_);
    vertices_.assign(character_.vertices.begin(), character_.vertices.end());
  }
  std::size_t vertex_at(Vec2 p) const {
    std::size_t best = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (length_sq(character_.vertices[i] - p) < length_sq(character_.vertices[best] - p)) best = i;
    }
    return best;
  }

  test::DrawnCharacter drawn_;
  Character character_;
  std::unique_ptr<test::Block> block_;
  DistortionMeter* meter_ = nullptr;
  std::vector<Vec2> vertices_;
};

TEST_F(DistortionTest, NoneAtRestHoweverItIsPlaced) {
  const det::SinCos a = det::sincos(0.7f);
  for (const bool y_down : {false, true}) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const Vec2 v = character_.vertices[i];
      const Vec2 p{3 * (a.cos * v.x - a.sin * v.y) + 40, 3 * (a.sin * v.x + a.cos * v.y) - 9};
      vertices_[i] = {p.x, y_down ? -p.y : p.y};
    }
    const Distortion d = meter_->measure(vertices_, 3.0f, y_down);
    EXPECT_EQ(d.inverted, 0);
    EXPECT_NEAR(d.least, 1, 1e-3f);
    EXPECT_NEAR(d.fin_area[kLeftFin], 1, 1e-4f);
    EXPECT_NEAR(d.fin_area[kRightFin], 1, 1e-4f);
    EXPECT_EQ(d.fin_area[kSecondLeftFin], 1);
  }
}

TEST_F(DistortionTest, CountsAndPlacesWhatTurnedOver) {
  const Vec2 at{0, -40};
  vertices_[vertex_at(at)] += Vec2{0, 6};  // past its neighbours, 4 units apart
  const Distortion d = meter_->measure(vertices_, 1.0f, false);
  EXPECT_GE(d.inverted, 1);
  EXPECT_LE(d.inverted, 4);
  EXPECT_LT(d.least, 0);
  EXPECT_LT(length(d.where - at), 8);
}

TEST_F(DistortionTest, AFinThatShrinksIsSeenAndTheOtherIsNot) {
  const FinPoints& fin = character_.rest.fins[kRightFin];
  for (Vec2& v : vertices_) {
    if (v.x > fin.top.x) v.x = fin.top.x + 0.5f * (v.x - fin.top.x);
  }
  const Distortion d = meter_->measure(vertices_, 1.0f, false);
  EXPECT_NEAR(d.fin_area[kRightFin], 0.55f, 0.06f);  // the body's rim lies a little inside the root
  EXPECT_NEAR(d.fin_area[kLeftFin], 1, 1e-4f);
  EXPECT_EQ(d.inverted, 0);
}

TEST(DistortionOfASolid, TrianglesThatStandUprightAreNotJudged) {
  // A tent: two slopes seen from above, and a gable that is seen almost on its edge.
  const std::vector<Vec2> vertices = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0.5f}};
  const std::vector<float> heights = {0, 0, 0, 0, 10};
  const std::vector<Vec3> normals(5, Vec3{0, 0, 1});
  const std::vector<uint32_t> triangles = {0, 1, 2, 0, 2, 3, 0, 1, 4};
  Character character;
  character.vertices = vertices, character.heights = heights, character.normals = normals;
  character.triangles = triangles;
  Arena measure;
  (void)DistortionMeter::create(measure, character);
  const test::Block block(measure.used());
  Arena arena(block.span());
  const DistortionMeter& meter = *DistortionMeter::create(arena, character);
  std::vector<Vec2> posed = vertices;
  posed[4] = {0, -0.5f};  // the gable leans the other way
  EXPECT_EQ(meter.measure(posed, 1, false).inverted, 0);
  posed[3] = {12, 6};  // a slope turns over
  EXPECT_EQ(meter.measure(posed, 1, false).inverted, 1);
}

}  // namespace
}  // namespace nt
