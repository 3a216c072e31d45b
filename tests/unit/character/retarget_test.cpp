// SPDX-License-Identifier: Apache-2.0
#include "core/character/retarget.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"
#include "tests/support/block.h"
#include "tests/support/drawn_character.h"

namespace nt {
namespace {

// A character with its retargeter and the memory of both.
class Stage {
 public:
  explicit Stage(RetargetSettings settings = unsmoothed(), bool fins = true, int u_num = 3, int l_num = 15)
      : drawn_(fins, u_num, l_num) {
    auto opened = open_character(drawn_.bytes(), Limits{});
    EXPECT_TRUE(opened.ok()) << opened.status().message;
    character_ = opened.value();
    Arena measure;
    EXPECT_EQ(Retarget::create(measure, character_, settings).value(), nullptr);
    memory_.resize(measure.used() + kAlignment);
    Arena arena(
        {reinterpret_cast<std::byte*>(align_up(reinterpret_cast<std::size_t>(memory_.data()))), measure.used()});
    auto made = Retarget::create(arena, character_, settings);
    EXPECT_TRUE(made.ok()) << made.status().message;
    retarget_ = made.value();
    retarget_->start(retarget_->lengths().body_len);
  }
  static RetargetSettings unsmoothed() {
    RetargetSettings s;
    s.smooth = false;
    return s;
  }
  Retarget& operator*() { return *retarget_; }
  Retarget* operator->() { return retarget_; }
  const Character& character() const { return character_; }
  // Triangles that turned over in the last pose (the scene's y is down: the sense at rest is the other one).
  int inverted() const {
    int count = 0;
    const auto t = character_.triangles;
    const auto v = character_.vertices, w = retarget_->vertices();
    for (std::size_t i = 0; i < t.size(); i += 3) {
      const float before = cross(v[t[i + 1]] - v[t[i]], v[t[i + 2]] - v[t[i]]);
      const float after = cross(w[t[i + 1]] - w[t[i]], w[t[i + 2]] - w[t[i]]);
      if (before * after >= 0) ++count;
    }
    return count;
  }

 private:
  test::DrawnCharacter drawn_;
  std::vector<std::byte> memory_;
  Character character_;
  Retarget* retarget_ = nullptr;
};

// Bends the body: `turn(s)` is added to the bone at share s of the way to the head (1) or tail (-1).
template <class F>
Motion bent(Motion m, F turn) {
  for (int i = 0; i < m.u_num; ++i)
    m.up_axis_angle[i] += turn((static_cast<float>(i) + 0.5f) / static_cast<float>(m.u_num + 1));
  m.head_angle += turn(1.0f);
  for (int i = 0; i < m.l_num; ++i)
    m.low_axis_angle[i] += turn(-(static_cast<float>(i) + 0.5f) / static_cast<float>(m.l_num + 1));
  m.tail_angle += turn(-1.0f);
  return m;
}

TEST(Retarget, BoneLengthsAddUpToTheAxis) {
  Stage stage;
  const BoneLengths& l = stage->lengths();
  EXPECT_NEAR(l.body_len, 150.0f, 1e-3f);
  EXPECT_NEAR(l.head_len, 14.0f, 1e-4f);
  EXPECT_NEAR(l.tail_len, 94.0f / 16, 1e-4f);
  EXPECT_NEAR(l.fin_len[kLeftFin], l.fin_len[kRightFin], 1e-4f);
  EXPECT_NEAR(l.fin_len[kLeftFin], length(Vec2{36, 30}), 1e-3f);
}

TEST(Retarget, TheRestMotionGivesTheRestPose) {
  for (const MlsKind kind : {MlsKind::rigid, MlsKind::similarity, MlsKind::affine}) {
    RetargetSettings settings = Stage::unsmoothed();
    settings.mls = kind;
    Stage stage(settings);
    stage->pose(stage->rest_motion(), 0, {});
    for (std::size_t i = 0; i < stage.character().vertices.size(); ++i) {
      const Vec2 rest = stage.character().vertices[i], now = stage->vertices()[i];
      ASSERT_NEAR(now.x, rest.x, 0.15f);  // 1e-3 of the body
      ASSERT_NEAR(now.y, -rest.y, 0.15f);
    }
  }
}

TEST(Retarget, CentreDirectionScaleAndPlacement) {
  Stage stage;
  stage->start(300.0f);  // the fish is 300 px long, the character 150 units: Eq 15 halves the way
  Motion m = stage->rest_motion();
  m.centre = {200, 100};
  m.dir_rad = 0;  // to the right of the picture
  stage->pose(m, 0, {{10, 20}, 3.0f});
  const ControlPoints& c = stage->control_points();
  EXPECT_NEAR(c.centre.x, 10 + 3 * 100, 1e-3f);
  EXPECT_NEAR(c.centre.y, 20 + 3 * 50, 1e-3f);
  EXPECT_NEAR(c.head.x - c.centre.x, 3 * 56, 0.01f);
  EXPECT_NEAR(c.head.y - c.centre.y, 0, 0.01f);
  EXPECT_LT(c.fins[kLeftFin].tip.y, c.fins[kRightFin].tip.y);  // swimming right on the screen its left is up
}

TEST(Retarget, BonesKeepTheirLengthsAndTakeTheMotionsAngles) {
  Stage stage;
  stage->pose(bent(stage->rest_motion(), [](float s) { return 0.8f * s; }), 0, {});
  const ControlPoints& c = stage->control_points();
  EXPECT_NEAR(length(c.tail - c.low_axis[14]), stage->lengths().tail_len, 1e-3f);
  EXPECT_NEAR(length(c.up_axis[0] - c.centre), stage->lengths().up_len[0], 1e-3f);
  const Vec2 bone = c.tail - c.low_axis[14];  // scene: x right, y down
  EXPECT_NEAR(det::wrap(det::atan2(-bone.y, bone.x) - (-det::kHalfPi - 0.8f)), 0.0f, 1e-3f);
}

TEST(Retarget, NoTriangleTurnsOverInABodyWave) {
  Stage stage;
  const Motion rest = stage->rest_motion();
  for (float phase = 0; phase < det::kTwoPi; phase += 0.3f) {
    const auto wave = [&](float s) { return (0.1f + 0.5f * det::max(-s, 0.0f)) * det::sin(5 * s + phase); };
    stage->pose(bent(rest, wave), 0, {});
    ASSERT_EQ(stage.inverted(), 0) << phase;
  }
}

TEST(Retarget, NoFinAngleTurnsATriangleOver) {
  Stage stage;
  for (float angle = -7.0f; angle < 7.0f; angle += 0.05f) {
    Motion m = stage->rest_motion();
    m.l_fin_angle = angle;
    m.r_fin_angle = -2.0f * angle;
    stage->pose(m, 0, {});
    ASSERT_EQ(stage.inverted(), 0) << angle;
  }
}

// How far a fin stands open in the last pose of an upright fish (scene: y down): as drawn, and by how far it has turned
// about its lower junction since.
float open_of(const Retarget& retarget, FinIndex index, float side) {
  const FinPoints& fin = retarget.control_points().fins[index];
  const Vec2 now = fin.tip - fin.bottom;
  return det::atan2(36, 30) + det::atan2(-now.y, side * now.x) - det::atan2(-10, 36);
}
float right_open(const Retarget& retarget) { return open_of(retarget, kRightFin, 1); }
float left_open(const Retarget& retarget) { return open_of(retarget, kLeftFin, -1); }

TEST(Retarget, AFoldedFishFinFoldsTheDrawnOneToItsLimitOnItsOwnSide) {
  Stage stage;
  Motion m = stage->rest_motion();
  for (const float beyond : {0.0f, 0.25f, 1.0f}) {  // across the body's line too
    m.l_fin_angle = kFoldedLeftFin + beyond;
    m.r_fin_angle = kFoldedRightFin - beyond;
    stage->pose(m, 0, {});
    EXPECT_NEAR(left_open(*stage), stage->fin_range(kLeftFin).folded, 1e-3f) << beyond;
    EXPECT_NEAR(right_open(*stage), stage->fin_range(kRightFin).folded, 1e-3f) << beyond;
  }
  EXPECT_LT(stage->fin_range(kLeftFin).folded, 0.7f);  // at rest 0.88: back by atan2(30, 36)
}

TEST(Retarget, AFishFinThatStandsOutOpensTheDrawnOneToItsLimit) {
  Stage stage;
  Motion m = stage->rest_motion();
  for (const float open : {kFishFins.open, 2.0f, 3.0f}) {
    m.l_fin_angle = -det::kHalfPi - open;
    m.r_fin_angle = -det::kHalfPi + open;
    stage->pose(m, 0, {});
    EXPECT_NEAR(left_open(*stage), stage->fin_range(kLeftFin).open, 1e-3f) << open;
    EXPECT_NEAR(right_open(*stage), stage->fin_range(kRightFin).open, 1e-3f) << open;
  }
}

TEST(Retarget, FinAmplitudesAreKeptInTheSameProportionAllOverTheRange) {
  Stage stage;
  const FinRange range = stage->fin_range(kRightFin);
  const float slope = range.width() / kFishFins.width();
  EXPECT_GT(slope, 0.6f);
  EXPECT_LE(slope, 1.0f + 1e-5f);
  Motion m = stage->rest_motion();
  for (float open = kFishFins.folded; open < kFishFins.open; open += 0.1f) {
    m.r_fin_angle = -det::kHalfPi + open;
    stage->pose(m, 0, {});
    EXPECT_NEAR(right_open(*stage), range.folded + slope * (open - kFishFins.folded), 1e-3f) << open;
  }
}

TEST(Retarget, AFinAngleMovesItsTipAndNotTheOtherFins) {
  Stage stage;
  Motion m = stage->rest_motion();
  stage->pose(m, 0, {});
  const ControlPoints before = stage->control_points();
  m.r_fin_angle += 0.1f;
  stage->pose(m, 0, {});
  const ControlPoints& after = stage->control_points();
  const float slope = stage->fin_range(kRightFin).width() / kFishFins.width();
  EXPECT_NEAR(length(after.fins[kRightFin].tip - before.fins[kRightFin].tip), length(Vec2{36, 10}) * 0.1f * slope,
              0.02f);
  EXPECT_LT(after.fins[kRightFin].tip.y, before.fins[kRightFin].tip.y);  // opens towards the head
  EXPECT_NEAR(length(after.fins[kLeftFin].tip - before.fins[kLeftFin].tip), 0.0f, 1e-3f);
}

TEST(Retarget, FinRangesHoldTheRestPose) {
  Stage stage;
  for (const FinRange r : {stage->fin_range(kLeftFin), stage->fin_range(kRightFin)}) {
    EXPECT_GE(r.folded, kFishFins.folded);
    EXPECT_LT(r.folded, 0.8f);
    EXPECT_GT(r.open, 1.0f);
    EXPECT_LE(r.width(), kFishFins.width() + 1e-5f);
  }
}

TEST(Retarget, WithoutFinsTheBodyMoves) {
  Stage stage(Stage::unsmoothed(), false);
  Motion m = stage->rest_motion();
  EXPECT_EQ(m.confidence.l_fin, 0.0f);
  stage->pose(bent(m, [](float s) { return 0.4f * s; }), 0, {});
  EXPECT_EQ(stage.inverted(), 0);
}

TEST(Retarget, AMotionWithOtherSamplesIsResampled) {
  Stage fine(Stage::unsmoothed(), true, 3, 25), coarse(Stage::unsmoothed(), true, 3, 15);
  const Motion m = bent(coarse->rest_motion(), [](float s) { return 0.7f * s; });
  fine->pose(m, 0, {});
  coarse->pose(m, 0, {});
  EXPECT_NEAR(length(fine->control_points().tail - coarse->control_points().tail), 0, 0.5f);
  EXPECT_NEAR(length(fine->control_points().head - coarse->control_points().head), 0, 1e-3f);
}

TEST(Retarget, TheFilterSmoothsAndStartsAgain) {
  RetargetSettings settings;
  Stage stage(settings);
  Motion m = stage->rest_motion();
  for (int i = 0; i < 30; ++i) stage->pose(m, 1.0f / 30, {});
  const Vec2 before = stage->control_points().tail;
  m.tail_angle += 0.4f;
  stage->pose(m, 1.0f / 180, {});
  const float step = length(stage->control_points().tail - before);
  const float whole = 2 * stage->lengths().tail_len * det::sin(0.2f);
  EXPECT_GT(step, 0.01f * whole);
  EXPECT_LT(step, 0.8f * whole);
  stage->start(stage->lengths().body_len);
  stage->pose(m, 1.0f / 180, {});
  EXPECT_NEAR(length(stage->control_points().tail - before), whole, 0.05f * whole);
}

TEST(Retarget, DirectionAcrossPiDoesNotSpinTheFilteredFish) {
  Stage stage{RetargetSettings{}};
  Motion m = stage->rest_motion();
  for (int i = 0; i < 40; ++i) {
    m.dir_rad = i % 2 == 0 ? 3.1f : -3.1f;  // 0.083 apart
    stage->pose(m, 1.0f / 30, {});
    EXPECT_LT(stage->control_points().head.x, stage->control_points().centre.x);
  }
}

TEST(Retarget, FinsKeepTheirAreaAndNoTriangleTurnsOverWhileBothMove) {
  Stage stage;
  const Motion rest = stage->rest_motion();
  for (int n = 0; n < 200; ++n) {
    const float t = 0.1f * static_cast<float>(n);
    Motion m = bent(rest, [&](float s) { return (0.1f + 0.4f * det::max(-s, 0.0f)) * det::sin(5 * s + 3 * t); });
    m.r_fin_angle = -det::kHalfPi + 0.9f + 0.6f * det::sin(t);
    m.l_fin_angle = -det::kHalfPi - 0.9f + 0.6f * det::sin(0.7f * t);
    stage->pose(m, 0, {{7, 9}, 2.5f});
    const Distortion d = stage->distortion();
    EXPECT_EQ(d.inverted, 0) << n;
    EXPECT_NEAR(d.fin_area[kLeftFin], 1, 0.1f) << n;
    EXPECT_NEAR(d.fin_area[kRightFin], 1, 0.1f) << n;
  }
}

TEST(Retarget, AFinsRootKeepsItsLengthWhileTheBodyBends) {
  Stage stage;
  const Motion rest = stage->rest_motion();
  stage->pose(rest, 0, {});
  const ControlPoints straight = stage->control_points();
  stage->pose(bent(rest, [](float s) { return 0.7f * s; }), 0, {});
  const ControlPoints round = stage->control_points();
  for (const FinIndex fin : {kLeftFin, kRightFin}) {
    const float len = length(straight.fins[fin].top - straight.fins[fin].bottom);
    EXPECT_NEAR(length(round.fins[fin].top - round.fins[fin].bottom), len, 1e-4f * len);
  }
}

TEST(Retarget, EveryKindOfDeformationKeepsTheDrawingWhole) {
  for (const MlsKind kind : {MlsKind::rigid, MlsKind::similarity, MlsKind::affine}) {
    RetargetSettings settings = Stage::unsmoothed();
    settings.mls = kind;
    Stage stage(settings);
    for (float phase = 0; phase < det::kTwoPi; phase += 0.3f) {
      stage->pose(bent(stage->rest_motion(), [&](float s) { return 0.3f * det::sin(4 * s + phase); }), 0, {});
      EXPECT_EQ(stage->distortion().inverted, 0) << static_cast<int>(kind) << ' ' << phase;
    }
  }
}

TEST(Retarget, ATwinPosesForItselfLikeTheOther) {
  Stage stage(RetargetSettings{});
  Arena measure;
  EXPECT_EQ(Retarget::twin(measure, *stage).value(), nullptr);
  const test::Block block(measure.used());
  Arena arena(block.span());
  Retarget& twin = *Retarget::twin(arena, *stage).value();
  twin.start(stage->lengths().body_len);
  const Motion rest = stage->rest_motion(), other = bent(rest, [](float s) { return 0.4f * s; });
  stage->pose(other, 0, {});
  const std::vector<Vec2> want(stage->vertices().begin(), stage->vertices().end());
  twin.pose(other, 0, {});
  stage->pose(rest, 1.0f / 30, {});  // does not disturb the twin, nor its filter
  twin.pose(other, 1.0f / 30, {});
  for (std::size_t i = 0; i < want.size(); ++i) {
    ASSERT_NEAR(twin.vertices()[i].x, want[i].x, 1e-3f);
    ASSERT_NEAR(twin.vertices()[i].y, want[i].y, 1e-3f);
  }
  EXPECT_GT(length(twin.vertices()[0] - stage->vertices()[0]), 0.1f);
}

TEST(Retarget, TooLittleMemoryIsAnError) {
  test::DrawnCharacter drawn;
  const auto opened = open_character(drawn.bytes(), Limits{});
  alignas(64) static std::byte memory[8192];
  Arena arena(memory);
  const auto made = Retarget::create(arena, opened.value(), {});
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.status().code, StatusCode::out_of_memory);
}

}  // namespace
}  // namespace nt
