// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/clip_editor.h"

#include <gtest/gtest.h>

#include "app/take_edit/curves.h"
#include "platform/camera.h"
#include "tests/app/swimming_motion.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;
using Setting = ClipEditor::Setting;

constexpr MotionProperty kTail{Kind::tail, 0}, kX{Kind::centre_x, 0}, kY{Kind::centre_y, 0};
constexpr int kFrames = 200;
constexpr double kFps = 30;

ClipEditor editor_of(const std::vector<const char*>& lines = {}) {
  std::vector<Edit> edits;
  for (const char* line : lines) edits.push_back(parse_edit(line));
  return {swimming(kFrames), edits, kFps};
}

float tail_at(const ClipEditor& editor, int64_t frame) {
  return value_of(editor.motions()[static_cast<std::size_t>(frame)], kTail);
}

void drag(ClipEditor& editor, MotionProperty property, float value) {
  const Setting setting{property, value};
  editor.hold(property);
  editor.drag_to({&setting, 1});
}

bool same(const Motion& a, const Motion& b) {
  for (const NamedCurve& curve : named_curves(a))
    if (value_of(a, curve.property) != value_of(b, curve.property)) return false;
  return a.time_ns == b.time_ns;
}

bool same(const std::vector<Motion>& a, const std::vector<Motion>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const Motion& x, const Motion& y) { return same(x, y); });
}

// What is on the screen is what the list, read back as text, makes of the recording.
void expect_as_by_text(const ClipEditor& editor) {
  std::vector<Edit> edits;
  for (const Edit& edit : editor.edits()) edits.push_back(parse_edit(to_line(edit)));
  EXPECT_TRUE(same(editor.motions(), apply_edits(editor.recorded(), editor.rest(), edits).motions));
}

TEST(ClipEditor, NeighboursFollowInsideTheWindowAndNobodyElse) {
  ClipEditor editor = editor_of();
  editor.go_to(45);  // the beat's peak: the tail is on one side from 41 to 49
  editor.select(kTail);
  const EditWindow window = editor.window();
  EXPECT_LE(window.p, 41);
  EXPECT_GE(window.q, 49);
  const float before = tail_at(editor, 45);
  drag(editor, kTail, before + 0.4f);
  EXPECT_NEAR(tail_at(editor, 45), before + 0.4f, 1e-4);
  for (int i = 0; i < kFrames; ++i) {
    const float moved = tail_at(editor, i) - value_of(editor.recorded()[static_cast<std::size_t>(i)], kTail);
    const bool outside = i <= window.p || i >= window.q;
    EXPECT_TRUE(outside ? moved == 0 : moved > 0) << i << " " << moved;
  }
  editor.release();
  ASSERT_EQ(editor.edits().size(), 1u);
  EXPECT_EQ(editor.edits()[0].what, "tail_angle");
  expect_as_by_text(editor);
}

TEST(ClipEditor, APullIsOneEditHoweverLongItTakes) {
  ClipEditor editor = editor_of();
  editor.go_to(45);
  const float before = tail_at(editor, 45);
  editor.hold(kTail);
  for (const float by : {0.1f, 0.6f, -0.9f, 0.3f}) {
    const Setting setting{kTail, before + by};
    editor.drag_to({&setting, 1});
  }
  editor.release();
  EXPECT_EQ(editor.edits().size(), 1u);
  expect_as_by_text(editor);
  ClipEditor at_once = editor_of();
  at_once.go_to(45);
  drag(at_once, kTail, before + 0.3f);
  EXPECT_TRUE(same(editor.motions(), at_once.motions()));
}

TEST(ClipEditor, WhatIsHeldButNotMovedIsNoEdit) {
  ClipEditor editor = editor_of();
  editor.hold(kTail);
  editor.release();
  EXPECT_TRUE(editor.edits().empty());
  EXPECT_FALSE(editor.unsaved());
}

TEST(ClipEditor, UndoAndRedoGoThroughEverything) {
  ClipEditor editor = editor_of({"set tail_angle 25 -1.1"});  // of an earlier day
  editor.go_to(45);
  drag(editor, kTail, -0.5f);
  editor.release();
  editor.smooth();
  const std::vector<Motion> all = editor.motions();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(editor.can_undo());
    editor.undo();
  }
  EXPECT_FALSE(editor.can_undo());
  EXPECT_TRUE(same(editor.motions(), editor.recorded()));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(editor.can_redo());
    editor.redo();
  }
  EXPECT_FALSE(editor.can_redo());
  EXPECT_TRUE(same(editor.motions(), all));
  editor.undo();
  editor.exaggerate(1.5);  // another way on: what was undone is gone
  EXPECT_FALSE(editor.can_redo());
}

TEST(ClipEditor, UndoWhileSomethingIsHeldLetsItGo) {
  ClipEditor editor = editor_of({"set tail_angle 25 -1.1"});
  const std::vector<Motion> before = editor.motions();
  editor.go_to(45);
  drag(editor, kTail, -0.5f);
  editor.undo();
  EXPECT_FALSE(editor.holding());
  EXPECT_TRUE(same(editor.motions(), before));
  EXPECT_EQ(editor.edits().size(), 1u);
}

TEST(ClipEditor, APositionIsOneStepOfTwoEdits) {
  ClipEditor editor = editor_of();
  editor.go_to(100);
  editor.set_radius(10);
  const Setting there[] = {{kX, 530}, {kY, 260}};
  editor.hold(kX);
  editor.drag_to(there);
  editor.release();
  ASSERT_EQ(editor.edits().size(), 2u);
  EXPECT_EQ(to_line(editor.edits()[1]), "move centre_y 100 260 10");
  EXPECT_EQ(editor.motions()[100].centre.y, 260);
  EXPECT_GT(editor.motions()[95].centre.y, 200);
  EXPECT_EQ(editor.motions()[90].centre.y, 200);
  expect_as_by_text(editor);
  editor.undo();
  EXPECT_TRUE(editor.edits().empty());
  editor.redo();
  EXPECT_EQ(editor.edits().size(), 2u);
}

TEST(ClipEditor, StretchesChangeTheRangeAlone) {
  ClipEditor editor = editor_of();
  editor.select(kTail);
  editor.go_to(60), editor.begin_range();
  editor.go_to(100), editor.end_range();
  editor.exaggerate(1.5);
  EXPECT_EQ(to_line(editor.edits().back()), "exaggerate body 60:100 1.5");
  EXPECT_EQ(tail_at(editor, 59), value_of(editor.recorded()[59], kTail));
  EXPECT_NE(tail_at(editor, 85), value_of(editor.recorded()[85], kTail));
  EXPECT_EQ(tail_at(editor, 101), value_of(editor.recorded()[101], kTail));
  expect_as_by_text(editor);
}

TEST(ClipEditor, FramesAreKnownAgainAfterTheyWereNumberedAnew) {
  ClipEditor editor = editor_of();
  editor.go_to(150);
  drag(editor, kTail, -1.2f);
  editor.release();
  EXPECT_EQ(editor.keys(kTail), std::vector<int64_t>{150});
  editor.go_to(60), editor.begin_range();
  editor.go_to(180), editor.end_range();
  editor.trim();
  EXPECT_EQ(editor.frames(), 121);
  EXPECT_EQ(editor.range(), (FrameRange{0, 120}));
  EXPECT_LT(editor.frame(), editor.frames());
  EXPECT_EQ(editor.recorded_at(10).time_ns, editor.recorded()[70].time_ns);
  EXPECT_TRUE(editor.keys(kTail).empty());  // of before the trim: their numbers are others
  editor.retime(2);
  EXPECT_EQ(editor.frames(), 61);
  EXPECT_EQ(editor.recorded_at(10).time_ns, editor.recorded()[80].time_ns);
  expect_as_by_text(editor);
  editor.undo(), editor.undo();
  EXPECT_EQ(editor.frames(), kFrames);
}

TEST(ClipEditor, WhatCannotBeDoneLeavesEverythingAsItIs) {
  std::vector<Motion> motions = swimming(20);
  for (Motion& motion : motions) motion.status = PoseStatus::lost;
  ClipEditor editor(motions, {}, kFps);
  EXPECT_THROW(editor.repair(), UserError);
  EXPECT_TRUE(editor.edits().empty());
  EXPECT_TRUE(same(editor.motions(), motions));
  EXPECT_FALSE(editor.unsaved());
  EXPECT_THROW(ClipEditor(swimming(20), {parse_edit("set tail_angle 20 1")}, kFps), UserError);
}

TEST(ClipEditor, TheFrameStaysWhileSomethingIsHeldAndInsideTheClip) {
  ClipEditor editor = editor_of();
  editor.go_to(-5);
  EXPECT_EQ(editor.frame(), 0);
  editor.go_to(10'000);
  EXPECT_EQ(editor.frame(), kFrames - 1);
  editor.hold(kTail);
  editor.go_to(3);
  EXPECT_EQ(editor.frame(), kFrames - 1);
  editor.release();
  editor.go_to(3);
  EXPECT_EQ(editor.frame(), 3);
}

TEST(ClipEditor, EditsOfOtherFishAreKeptAndHaveNoEffect) {
  std::vector<Edit> edits;
  for (const char* line : {"fish 2 set tail_angle 45 -1", "set tail_angle 65 -1.1", "fish 1 set tail_angle 85 -1.2"})
    edits.push_back(parse_edit(line));
  ClipEditor editor(swimming(kFrames), edits, kFps, 2);
  EXPECT_EQ(tail_at(editor, 45), -1.0f);
  EXPECT_EQ(tail_at(editor, 65), -1.1f);
  EXPECT_EQ(tail_at(editor, 85), value_of(editor.recorded()[85], kTail));
  editor.go_to(105);
  drag(editor, kTail, -1.3f);
  editor.release();
  EXPECT_EQ(to_line(editor.edits().back()), "fish 2 set tail_angle 105 -1.3");
  for (int i = 0; i < 3; ++i) editor.undo();
  EXPECT_FALSE(editor.can_undo());
  ASSERT_EQ(editor.edits().size(), 1u);
  EXPECT_EQ(editor.edits()[0].fish, 1);
  EXPECT_TRUE(same(editor.motions(), editor.recorded()));
  for (int i = 0; i < 3; ++i) editor.redo();
  EXPECT_EQ(tail_at(editor, 105), -1.3f);
}

TEST(ClipEditor, SavedIsWhatWasSaved) {
  ClipEditor editor = editor_of();
  drag(editor, kTail, -1);
  EXPECT_FALSE(editor.unsaved());  // not a step yet
  editor.release();
  EXPECT_TRUE(editor.unsaved());
  editor.mark_saved();
  EXPECT_FALSE(editor.unsaved());
  editor.undo();
  EXPECT_TRUE(editor.unsaved());
}

TEST(NamedCurves, AreBonesOfTheMotionAndReadBothWays) {
  for (const auto& [up, low] : {std::pair{3, 15}, {1, 1}, {8, 32}}) {
    const Motion rest = straight_motion(up, low);
    const std::vector<NamedCurve> curves = named_curves(rest);
    EXPECT_GE(curves.size(), 8u);
    EXPECT_LE(curves.size(), 12u);
    for (const NamedCurve& curve : curves) {
      ASSERT_TRUE(has(rest, curve.property)) << curve.name;
      EXPECT_EQ(plain_name(curve.property, curves), plain_name(curve.property, named_curves(rest)));
      const float shown = degrees_or_pixels(1.25f, curve.property, rest);
      EXPECT_NEAR(from_degrees_or_pixels(shown, curve.property, rest), 1.25f, 1e-5) << curve.name;
    }
    EXPECT_EQ(degrees_or_pixels(value_of(rest, kTail), kTail, rest), 0);
  }
  EXPECT_EQ(plain_name({Kind::low_axis, 6}, named_curves(straight_motion(3, 15))), "Tail joint 7");
}

}  // namespace
}  // namespace nt
