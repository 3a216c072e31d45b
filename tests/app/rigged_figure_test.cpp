// SPDX-License-Identifier: Apache-2.0
#include "app/author/rigged_figure.h"

#include <gtest/gtest.h>

#include "app/author/character_file.h"
#include "app/author/picture_character.h"
#include "core/character/retarget.h"
#include "tests/app/straight_rig.h"
#include "tests/support/drawn_character.h"

namespace nt {
namespace {

using test::expect_near;

const LoadedCharacter& carp() {
  static const LoadedCharacter loaded(author_picture(NEONTETRA_ASSETS "/characters/carp.png", {}).bytes, "carp", {});
  return loaded;
}

Corrections with(std::initializer_list<const char*> lines) {
  Corrections c;
  for (const char* line : lines) set_correction(c, "test", line);
  return c;
}

// Through a file and back.
LoadedCharacter saved(const RiggedCharacter& made) { return {character_bytes(made.character), "saved", Limits{}}; }

void expect_same_rig(const Rig& a, const Rig& b, float tolerance) {
  ASSERT_EQ(points_of(a), points_of(b));
  for (const PointId id : points_of(a)) {
    SCOPED_TRACE(point_name(id));
    expect_near(point_at(a, id), point_at(b, id), tolerance);
    EXPECT_FLOAT_EQ(point_confidence(a, id), point_confidence(b, id));
  }
}

TEST(RiggedFigure, TheCarpIsInPixelsOfItsTexture) {
  const RiggedFigure figure(carp().character());
  const Character& c = carp().character();
  for (std::size_t i = 0; i < c.vertices.size(); i += 97) {
    expect_near(figure.vertices()[i],
                {c.texcoords[i].x * static_cast<float>(c.texture.width) - 0.5f,
                 c.texcoords[i].y * static_cast<float>(c.texture.height) - 0.5f},
                0.01f);
  }
  EXPECT_GT(figure.found().head.x, 900);  // it swims to the right
}

TEST(RiggedFigure, TakenApartAndPutTogetherItIsTheSame) {
  const RiggedFigure figure(carp().character());
  const RiggedCharacter made = figure.with(figure.found());
  const LoadedCharacter again = saved(made);
  const Character &before = carp().character(), &after = again.character();
  for (std::size_t i = 0; i < before.vertices.size(); ++i) expect_near(after.vertices[i], before.vertices[i], 0.01f);
  EXPECT_TRUE(std::equal(before.triangles.begin(), before.triangles.end(), after.triangles.begin()));
  expect_near(after.rest.fins[kRightFin].tip, before.rest.fins[kRightFin].tip, 0.01f);
  EXPECT_EQ(after.confidences[1], before.confidences[1]);
  EXPECT_EQ(after.harmonics, before.harmonics);
}

TEST(RiggedFigure, CorrectionsAreWhatIsSavedAndTheyMayBeMadeAgain) {
  const Corrections c = with({"centre = 600,260", "l_fin = 600,40", "fins = 2", "midline = 960,250 500,230 110,260",
                              "l_num = 9", "tail_fin = no", "deformer = similarity"});
  const RiggedFigure figure(carp().character());
  const Rig rig = corrected(figure.found_for(c), c);
  const LoadedCharacter once = saved(figure.with(rig));
  const RiggedFigure reopened(once.character());
  expect_same_rig(reopened.found(), rig, 0.02f);
  EXPECT_EQ(once.character().l_num, 9);
  EXPECT_FALSE(once.character().has_tail_fin);
  EXPECT_EQ(once.character().deformer, MlsKind::similarity);
  expect_near(once.character().rest.centre, {0, 0}, 0.001f);
  expect_same_rig(corrected(reopened.found_for(c), c), rig, 0.05f);
  for (std::size_t i = 0; i < figure.vertices().size(); i += 97)
    expect_near(reopened.vertices()[i], figure.vertices()[i], 0.02f);
}

TEST(RiggedFigure, AFlippedCharacterIsTheMirrorImageAndOpensAsTheFigure) {
  const Corrections c = with({"flip = yes", "l_fin = 600,40"});
  const RiggedFigure figure(carp().character());
  const Rig rig = corrected(figure.found(), c);
  const LoadedCharacter flipped = saved(figure.with(rig));
  const Character& f = flipped.character();
  for (std::size_t i = 0; i < f.triangles.size(); i += 3) {
    const Vec2 a = f.vertices[f.triangles[i]];
    ASSERT_GT(cross(f.vertices[f.triangles[i + 1]] - a, f.vertices[f.triangles[i + 2]] - a), 0) << i;
  }
  EXPECT_LT(f.rest.fins[kLeftFin].tip.x, 0);
  EXPECT_GT(f.rest.fins[kRightFin].tip.x, 0);
  const RiggedFigure reopened(f);
  EXPECT_TRUE(reopened.found().flip);
  expect_same_rig(reopened.found(), rig, 0.02f);
  EXPECT_NEAR(f.rest.fins[kRightFin].tip.y, dot(Vec2{600, 40} - rig.centre, f.figure.dir), 0.5f);  // was the left one
}

TEST(RiggedFigure, TurnedRoundItStillHasTrianglesOfPositiveAreaAndSwims) {
  const Corrections c = with({"head_end = left"});
  const RiggedFigure figure(carp().character());
  const LoadedCharacter turned = saved(figure.with(corrected(figure.found(), c)));
  const Character& t = turned.character();
  EXPECT_GT(t.rest.head.y, 0);
  EXPECT_LT(t.rest.fins[kLeftFin].tip.x, 0);
  Arena measure;
  (void)Retarget::create(measure, t, {});
  const AlignedBlock block(measure.used());
  Arena arena(block.bytes());
  EXPECT_TRUE(Retarget::create(arena, t, {}).ok());
}

TEST(RiggedFigure, ProposingAnewFindsTheCarpsPointsInItsMesh) {
  const RiggedFigure figure(carp().character());
  const Rig now = figure.found();
  const Rig anew = figure.propose(now, 5);
  // The mesh's outline is a pixel or two off the picture's; where a round fin's tip is, a matter of such pixels.
  for (const char* name : {"head", "tail", "low_axis_8", "l_fin", "r_fin"}) {
    SCOPED_TRACE(name);
    const PointId point = *point_named(name);
    expect_near(point_at(anew, point), point_at(now, point), point.of_fin() ? 50 : 25);
  }
  EXPECT_EQ(figure.propose(now, 8).harmonics, 8);
  EXPECT_EQ(figure.found_for(with({"harmonics = 6"})).harmonics, 6);
  Rig other_way = now;
  swap_ends(other_way);
  EXPECT_LT(figure.propose(other_way, 5).head.x, 200);
}

TEST(RiggedFigure, ASolidKeepsItsHeightsAndIsPaintedFromBelow) {
  test::DrawnCharacter drawn(true, 3, 15, true);
  const Result<Character> opened = open_character(drawn.bytes(), Limits{});
  ASSERT_TRUE(opened.ok());
  const RiggedFigure figure(opened.value());
  EXPECT_TRUE(figure.solid());
  const std::span<const uint32_t> t = figure.triangles();
  const auto height = [&](std::size_t i) {
    const auto& z = opened.value().heights;
    return z[t[i]] + z[t[i + 1]] + z[t[i + 2]];
  };
  for (std::size_t i = 3; i + 2 < t.size(); i += 3) ASSERT_GE(height(i), height(i - 3) - 1e-4f);
  const RiggedCharacter made = figure.with(corrected(figure.found(), with({"head_end = down"})));
  EXPECT_EQ(made.character.heights[7], opened.value().heights[7]);
  EXPECT_NEAR(made.normals[7].x, -opened.value().normals[7].x, 1e-4f);  // turned by half a turn
  EXPECT_EQ(made.normals[7].z, opened.value().normals[7].z);
}

}  // namespace
}  // namespace nt
