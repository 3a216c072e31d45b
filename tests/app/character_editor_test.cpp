// SPDX-License-Identifier: Apache-2.0
// The editor's window on SDL's driver without a screen, with SDL's own mouse and finger events.
#include "app/ui/character_editor.h"

#include "app/author/character_file.h"
#include "app/author/picture_character.h"
#include "tests/app/straight_rig.h"
#include "tests/app/window_driver.h"

namespace nt {
namespace {

using test::expect_near;

const LoadedCharacter& carp() {
  static const LoadedCharacter loaded(author_picture(NEONTETRA_ASSETS "/characters/carp.png", {}).bytes, "carp", {});
  return loaded;
}

PointId id(const char* name) { return *point_named(name); }

class CharacterEditorTest : public test::WindowDriver {
 protected:
  void SetUp() override {
    WindowDriver::SetUp();
    if (!display_) return;
    editor_ = std::make_unique<CharacterEditor>(*display_, "carp.ntchar", carp().character(), Corrections{},
                                                [this](const Character& c, const Corrections& by) { save(c, by); });
    frames(3);
  }
  void TearDown() override {
    editor_.reset();
    WindowDriver::TearDown();
  }
  EditorWindow& shown() override { return *editor_; }
  void save(const Character& character, const Corrections& by) {
    if (disk_is_full_) throw UserError("cannot write carp.ntchar: the disk is full");
    saved_rig_ = RiggedFigure(character).found();
    saved_ = by;
    ++saves_;
  }
  // The middle of the n-th of five buttons over the canvas.
  Vec2 bar_button(int n) const {
    return {editor_->canvas().size.x * (static_cast<float>(n) + 0.5f) / 5, 0.5f * editor_->canvas().corner.y};
  }

  std::unique_ptr<CharacterEditor> editor_;
  Rig saved_rig_;
  Corrections saved_;
  int saves_ = 0;
  bool disk_is_full_ = false;
};

TEST_P(CharacterEditorTest, MouseAndFingerDragPointsTheWayTheyGo) {
  if (!editor_) return;
  for (const bool by_finger : {false, true}) {
    const Vec2 tail = editor_->on_screen(id("tail"));
    drag(tail, tail + Vec2{30, 20}, by_finger);
    expect_near(editor_->on_screen(id("tail")), tail + Vec2{30, 20}, 1.6f);
    EXPECT_EQ(editor_->editor().selected(), id("tail"));
    EXPECT_FALSE(editor_->editor().held());
    key(SDLK_z, KMOD_LCTRL);
    expect_near(editor_->on_screen(id("tail")), tail, 0.1f);
  }
}

TEST_P(CharacterEditorTest, WhatIsDraggedIsSavedByTheButtonUnderAFinger) {
  if (!editor_) return;
  const Vec2 tip = editor_->on_screen(id("l_fin"));
  drag(tip, tip + Vec2{-25, 10}, true);
  tap(bar_button(3));
  EXPECT_EQ(saves_, 1);
  EXPECT_EQ(saved_.moved.size(), 1u);
  expect_near(saved_rig_.fins[0].tip, editor_->editor().rig().fins[0].tip, 0.05f);
  EXPECT_FALSE(editor_->editor().unsaved());
  tap(bar_button(0));  // undo
  expect_near(editor_->on_screen(id("l_fin")), tip, 0.1f);
  tap(bar_button(1));  // redo
  expect_near(editor_->on_screen(id("l_fin")), tip + Vec2{-25, 10}, 1.6f);
  tap(bar_button(4));  // close: nothing to save after undo and redo? there is, so it asks
  EXPECT_TRUE(editor_->asking());
}

TEST_P(CharacterEditorTest, OneTapIsOnePress) {
  if (!editor_) return;
  tap(bar_button(2));
  EXPECT_TRUE(editor_->swimming());
  frames(10);
  EXPECT_TRUE(editor_->swimming());
  tap(bar_button(2));
  EXPECT_FALSE(editor_->swimming());
}

TEST_P(CharacterEditorTest, ItSwimsAtOnceAndWithWhatWasChanged) {
  if (!editor_) return;
  const std::vector<uint8_t> still = picture();
  key(SDLK_SPACE);
  ASSERT_TRUE(editor_->swimming());
  frames(10);
  const std::vector<uint8_t> first = picture();
  frames(30);
  const std::vector<uint8_t> later = picture();
  EXPECT_NE(first, still);
  EXPECT_NE(later, first);
  key(SDLK_SPACE);
  EXPECT_FALSE(editor_->swimming());
}

TEST_P(CharacterEditorTest, AMidlineIsDrawnWithAFinger) {
  if (!editor_) return;
  key(SDLK_2);
  const Vec2 head = editor_->on_screen(id("head")), tail = editor_->on_screen(id("tail"));
  drag(head + Vec2{-15, 10}, tail + Vec2{20, -15}, true);
  EXPECT_FALSE(editor_->editor().corrections().midline.empty());
  expect_near(editor_->on_screen(id("head")), head + Vec2{-15, 10}, 2);
  expect_near(editor_->on_screen(id("tail")), tail + Vec2{20, -15}, 2);
}

TEST_P(CharacterEditorTest, ASecondFingerChangesNothing) {
  if (!editor_) return;
  const Vec2 tail = editor_->on_screen(id("tail"));
  finger(SDL_FINGERDOWN, tail, 1), frames(3);
  finger(SDL_FINGERDOWN, editor_->on_screen(id("head")), 2), frames(3);
  finger(SDL_FINGERMOTION, {50, 100}, 2), frames(3);
  EXPECT_EQ(editor_->editor().held(), id("tail"));
  expect_near(editor_->on_screen(id("tail")), tail, 0.6f);
  finger(SDL_FINGERUP, tail, 1), frames(4);
  EXPECT_FALSE(editor_->editor().held());
}

TEST_P(CharacterEditorTest, LeavingAsksWhereSomethingIsNotSaved) {
  if (!editor_) return;
  key(SDLK_m);
  key(SDLK_q);
  EXPECT_TRUE(editor_->asking());
  key(SDLK_ESCAPE);
  EXPECT_FALSE(editor_->asking());
  key(SDLK_s, KMOD_LCTRL);
  EXPECT_EQ(saves_, 1);
  EXPECT_EQ(saved_.mirror, true);
  SDL_Event quit{};
  quit.type = SDL_QUIT;
  SDL_PushEvent(&quit);
  EXPECT_FALSE(frames(1));
}

TEST_P(CharacterEditorTest, AFailedSaveIsToldAndStaysUnsaved) {
  if (!editor_) return;
  key(SDLK_m);
  disk_is_full_ = true;
  key(SDLK_s, KMOD_LCTRL);
  EXPECT_TRUE(editor_->editor().unsaved());
  EXPECT_TRUE(frames(2));
}

// Every button of the side panel is on the screen and does something: 9 rows, none scrolled away.
TEST_P(CharacterEditorTest, TheLastRowOfButtonsIsOnTheScreen) {
  if (!editor_) return;
  const float side = static_cast<float>(size_.width) - editor_->canvas().size.x;
  const Rig before = editor_->editor().rig();
  // "Swap ends" is at the left of the last row, whose bottom is the window's when the rows just fit.
  bool swapped = false;
  for (float y = static_cast<float>(size_.height) - 10; y > 0.5f * static_cast<float>(size_.height) && !swapped;
       y -= 12) {
    tap({editor_->canvas().size.x + 0.25f * side, y});
    swapped = length(editor_->editor().rig().head - before.tail) < 1;
  }
  EXPECT_TRUE(swapped);
}

INSTANTIATE_TEST_SUITE_P(Sizes, CharacterEditorTest, ::testing::Values(DisplaySize{960, 600}, DisplaySize{800, 480}),
                         test::size_name);

}  // namespace
}  // namespace nt
