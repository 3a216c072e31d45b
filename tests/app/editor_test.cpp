// SPDX-License-Identifier: Apache-2.0
#include "app/character_edit/editor.h"

#include <gtest/gtest.h>

#include "tests/app/straight_rig.h"

namespace nt {
namespace {

using test::expect_near;
using test::straight_rig;

constexpr float kReach = 20;

Rig proposed(const Rig& now, int harmonics) {
  Rig rig = straight_rig(now.u_num, now.l_num);
  rig.harmonics = harmonics;
  rig.head.y += static_cast<float>(harmonics);
  return rig;
}

class EditorTest : public ::testing::Test {
 protected:
  void drag(Vec2 from, Vec2 to) {
    editor_.press(from, kReach);
    editor_.drag(lerp(from, to, 0.5f));
    editor_.drag(to);
    editor_.release();
  }
  void tap(Vec2 at) {
    editor_.press(at, kReach);
    editor_.release();
  }
  Editor editor_{straight_rig(), {}, proposed};
};

TEST_F(EditorTest, APointIsDraggedByWhereItIsHeldAndUndoneInOneStep) {
  drag({905, 304}, {925, 314});  // held 5 px beside the head
  expect_near(editor_.rig().head, {920, 310}, 0.01f);
  EXPECT_EQ(editor_.selected(), point_named("head"));
  EXPECT_TRUE(editor_.unsaved());
  editor_.undo();
  expect_near(editor_.rig().head, {900, 300}, 0);
  EXPECT_FALSE(editor_.can_undo());
  editor_.redo();
  expect_near(editor_.rig().head, {920, 310}, 0.01f);
}

TEST_F(EditorTest, TwoDragsAreTwoSteps) {
  drag({900, 300}, {910, 300});
  drag({910, 300}, {920, 300});
  editor_.undo();
  expect_near(editor_.rig().head, {910, 300}, 0.01f);
}

TEST_F(EditorTest, NothingNearIsNothingHeld) {
  drag({700, 500}, {720, 500});
  EXPECT_FALSE(editor_.can_undo());
  EXPECT_FALSE(editor_.held());
}

TEST_F(EditorTest, EndsAreFoundBeforeAxisPointsAroundThem) {
  place_point(const_cast<Rig&>(editor_.rig()), *point_named("up_axis_3"), {890, 300});
  EXPECT_EQ(editor_.hit({896, 300}, kReach), point_named("head"));
  EXPECT_EQ(editor_.hit({891, 300}, kReach), point_named("up_axis_3"));
}

TEST_F(EditorTest, WithMirrorTheOtherSideFollowsAndStaysWhenMirrorGoes) {
  editor_.set_mirror(true);
  drag({500, 180}, {480, 150});
  expect_near(editor_.rig().fins[1].tip, {480, 450}, 0.11f);
  editor_.set_mirror(false);
  expect_near(editor_.rig().fins[1].tip, {480, 450}, 0.11f);
  drag({480, 150}, {470, 140});
  expect_near(editor_.rig().fins[1].tip, {480, 450}, 0.11f);
}

TEST_F(EditorTest, ALoadedMirrorIsKeptWhenItIsSwitchedOff) {
  Corrections c;
  set_correction(c, "test", "l_fin = 480,150");
  set_correction(c, "test", "mirror = yes");
  Editor editor(straight_rig(), c, proposed);
  editor.set_mirror(false);
  expect_near(editor.rig().fins[1].tip, {480, 450}, 0.11f);
}

TEST_F(EditorTest, AMidlineIsDrawnInEitherDirection) {
  editor_.choose(Tool::midline);
  for (const bool from_tail : {false, true}) {
    const Vec2 head{880, 340}, tail{140, 380};
    editor_.press(from_tail ? tail : head, kReach);
    for (int i = 1; i <= 60; ++i)
      editor_.drag(lerp(from_tail ? tail : head, from_tail ? head : tail, static_cast<float>(i) / 60));
    EXPECT_GT(editor_.stroke().size(), 30u);
    editor_.release();
    expect_near(editor_.rig().head, head, 1);
    expect_near(editor_.rig().tail, tail, 1);
    EXPECT_LE(editor_.corrections().midline.size(), 20u);
    EXPECT_TRUE(editor_.stroke().empty());
  }
  editor_.undo(), editor_.undo();
  expect_near(editor_.rig().head, {900, 300}, 0);
}

TEST_F(EditorTest, ASlipIsNoMidline) {
  editor_.choose(Tool::midline);
  drag({500, 300}, {560, 300});
  EXPECT_FALSE(editor_.can_undo());
}

TEST_F(EditorTest, FinsArePlacedOnTheirSideMovedAndRemovedByATap) {
  editor_.choose(Tool::fins);
  tap({300, 200});  // above: the fish's left
  ASSERT_TRUE(editor_.rig().fins[2].present);
  EXPECT_FALSE(editor_.rig().fins[3].present);
  expect_near(editor_.rig().fins[2].tip, {300, 200}, 0);
  drag({300, 200}, {280, 190});
  expect_near(editor_.rig().fins[2].tip, {280, 190}, 0.01f);
  tap({280, 190});
  EXPECT_FALSE(editor_.rig().fins[2].present);
  EXPECT_EQ(editor_.fin_pairs(), 1);
  editor_.set_mirror(true);
  tap({300, 400});
  EXPECT_TRUE(editor_.rig().fins[2].present);
  EXPECT_TRUE(editor_.rig().fins[3].present);
  tap({300, 400});
  EXPECT_EQ(editor_.fin_pairs(), 1);
}

TEST_F(EditorTest, FinPairsAreSetAsAWhole) {
  editor_.set_fin_pairs(0);
  EXPECT_EQ(editor_.fin_pairs(), 0);
  editor_.set_fin_pairs(2);
  for (const RigFin& fin : editor_.rig().fins) EXPECT_TRUE(fin.present);
  editor_.undo(), editor_.undo();
  EXPECT_EQ(editor_.fin_pairs(), 1);
}

TEST_F(EditorTest, NumbersOfAxisPointsKeepWhatWasMovedAndASliderIsOneStep) {
  drag({350, 300}, {350, 340});  // low_axis_8
  for (int l = 16; l <= 25; ++l) editor_.set_axis(4, l);
  editor_.end_gesture();
  EXPECT_EQ(editor_.rig().u_num, 4);
  EXPECT_EQ(editor_.rig().l_num, 25);
  EXPECT_EQ(point_at(editor_.rig(), *point_named("low_axis_13")).y > 325, true);
  editor_.undo();
  EXPECT_EQ(editor_.rig().l_num, 15);
  expect_near(editor_.rig().low_axis[7], {350, 340}, 0.01f);
}

TEST_F(EditorTest, HarmonicsProposeAnewUnderTheCorrections) {
  drag({500, 180}, {480, 150});
  editor_.set_harmonics(8);
  EXPECT_EQ(editor_.rig().harmonics, 8);
  EXPECT_EQ(editor_.corrections().harmonics, 8);
  expect_near(editor_.rig().head, {900, 308}, 0);
  expect_near(editor_.rig().fins[0].tip, {480, 150}, 0.01f);
  editor_.undo();
  expect_near(editor_.rig().head, {900, 300}, 0);
}

TEST_F(EditorTest, HeadAndTailChangePlacesWithEverythingThatWasMoved) {
  editor_.choose(Tool::move);
  drag({500, 180}, {480, 150});
  drag({350, 300}, {350, 340});
  const Rig before = editor_.rig();
  editor_.swap_head_and_tail();
  expect_near(editor_.rig().head, before.tail, 1);
  expect_near(editor_.rig().fins[1].tip, before.fins[0].tip, 0.01f);
  expect_near(editor_.rig().fins[1].top, before.fins[0].bottom, 0.01f);
  editor_.swap_head_and_tail();
  expect_near(editor_.rig().head, before.head, 1);
  expect_near(editor_.rig().fins[0].tip, before.fins[0].tip, 0.01f);
}

TEST_F(EditorTest, ProposingAnewTakesThePointsBackAndCanBeUndone) {
  drag({500, 180}, {480, 150});
  editor_.set_flip(true);
  editor_.propose_anew();
  expect_near(editor_.rig().fins[0].tip, {500, 180}, 0);
  EXPECT_TRUE(editor_.rig().flip);
  editor_.undo();
  expect_near(editor_.rig().fins[0].tip, {480, 150}, 0.01f);
}

TEST_F(EditorTest, AChangeThatCannotBeIsNotMade) {
  drag({675, 300}, {600, 300});  // up_axis_1 onto the centre
  const float gap = length(editor_.rig().up_axis[0] - editor_.rig().centre);
  EXPECT_GT(gap, 1);
  EXPECT_NO_THROW((void)corrected(straight_rig(), editor_.corrections()));
}

TEST_F(EditorTest, SavedIsSavedUntilTheNextChange) {
  EXPECT_FALSE(editor_.unsaved());
  editor_.set_deformer(MlsKind::affine);
  EXPECT_TRUE(editor_.unsaved());
  editor_.mark_saved();
  EXPECT_FALSE(editor_.unsaved());
  editor_.undo();
  EXPECT_TRUE(editor_.unsaved());
}

TEST_F(EditorTest, TheArrowKeysMoveTheSelectedPoint) {
  tap({900, 300});
  EXPECT_FALSE(editor_.can_undo());
  editor_.nudge({1, 0});
  expect_near(editor_.rig().head, {901, 300}, 0.01f);
}

}  // namespace
}  // namespace nt
