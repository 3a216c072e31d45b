// SPDX-License-Identifier: Apache-2.0
// The take editor's window on SDL's driver without a screen, with SDL's own mouse and finger events.
#include "app/ui/take_editor.h"

#include <filesystem>

#include "app/export/video_writer.h"
#include "tests/app/swimming_motion.h"
#include "tests/app/window_driver.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

constexpr MotionProperty kTail{Kind::tail, 0}, kFin{Kind::l_fin, 0}, kHead{Kind::head, 0}, kCentre{Kind::centre_x, 0};
constexpr int kFrames = 160;

// Its fins open for frames 60 to 99.
std::vector<Motion> motions() {
  std::vector<Motion> m = swimming(kFrames);
  for (std::size_t i = 60; i < 100; ++i) m[i].l_fin_angle = -2.4f, m[i].confidence.l_fin = 0.8f;
  return m;
}

const Wardrobe& carp() {
  static const Wardrobe wardrobe({NEONTETRA_ASSETS "/characters/carp.png"}, std::nullopt);
  return wardrobe;
}

class TakeEditorTest : public test::WindowDriver {
 protected:
  void SetUp() override {
    WindowDriver::SetUp();
    if (display_) open({});
  }
  void open(std::vector<Edit> edits) {
    editor_.reset();
    editor_ = std::make_unique<TakeEditor>(*display_, EditedClip{motions(), std::move(edits), 30, 180, {960, 544}},
                                           carp(), [this](const std::vector<Edit>& list) { save(list); });
    frames(3);
  }
  void TearDown() override {
    editor_.reset();
    WindowDriver::TearDown();
  }
  EditorWindow& shown() override { return *editor_; }
  void save(const std::vector<Edit>& list) {
    if (disk_is_full_) throw UserError("cannot write t.take: the disk is full");
    saved_ = list;
    ++saves_;
  }
  void go_to(int frame) {
    const int64_t away = frame - clip().frame();
    for (int64_t i = 0; i < std::abs(away); ++i) press_key(away > 0 ? SDLK_RIGHT : SDLK_LEFT);
    frames(2);
  }
  const ClipEditor& clip() const { return editor_->editor(); }
  float value(MotionProperty property, int frame) const {
    return value_of(clip().motions()[static_cast<std::size_t>(frame)], property);
  }
  // The middle of the n-th of seven buttons over the canvas.
  Vec2 bar_button(int n) const {
    return {editor_->canvas().size.x * (static_cast<float>(n) + 0.5f) / 7, 0.5f * editor_->canvas().corner.y};
  }

  std::unique_ptr<TakeEditor> editor_;
  std::vector<Edit> saved_;
  int saves_ = 0;
  bool disk_is_full_ = false;
};

TEST_P(TakeEditorTest, AFinIsDraggedTheNeighboursFollowAtOnceAndItIsUndone) {
  if (!editor_) return;
  for (const bool by_finger : {false, true}) {
    go_to(80);
    const Vec2 tip = editor_->on_screen(kFin), to = tip + Vec2{-16, 4};
    drag(tip, to, by_finger, false);
    EXPECT_EQ(clip().selected(), kFin);
    EXPECT_LT(length(editor_->on_screen(kFin) - to), 0.6f * length(tip - to));  // as near as a fin can come by turning
    EXPECT_GT(length(editor_->on_screen(kFin) - tip), 8);
    const float moved = value(kFin, 80) + 2.4f;
    EXPECT_GT(std::abs(moved), 0.1f);
    EXPECT_GT(moved * (value(kFin, 75) + 2.4f), 0);  // while it is still held
    EXPECT_EQ(value(kFin, 50), motions()[50].l_fin_angle);
    by_finger ? finger(SDL_FINGERUP, to) : mouse(SDL_MOUSEBUTTONUP, to);
    frames(3);
    EXPECT_EQ(clip().edits().size(), 1u);
    key(SDLK_z, KMOD_LCTRL);
    EXPECT_TRUE(clip().edits().empty());
    EXPECT_EQ(value(kFin, 80), -2.4f);
  }
}

TEST_P(TakeEditorTest, TheListIsSavedByItselfAndTakenUpAgain) {
  if (!editor_) return;
  go_to(45);
  const Vec2 tail = editor_->on_screen(kTail);
  drag(tail, tail + Vec2{0, -20}, true);
  EXPECT_EQ(saves_, 0);
  frames(60);
  EXPECT_EQ(saves_, 1);
  ASSERT_EQ(saved_.size(), 1u);
  const float edited = value(kTail, 45);
  open(saved_);
  EXPECT_EQ(value(kTail, 45), edited);
  EXPECT_NE(edited, motions()[45].tail_angle);
  tap(bar_button(0));  // an edit of an earlier session is undone too
  EXPECT_EQ(value(kTail, 45), motions()[45].tail_angle);
  tap(bar_button(1));
  EXPECT_EQ(value(kTail, 45), edited);
}

TEST_P(TakeEditorTest, TheThickCurveIsDragged) {
  if (!editor_) return;
  go_to(45);
  const Vec2 at = editor_->on_plot(45);
  for (const bool by_finger : {false, true}) {
    drag(at, at + Vec2{0, -12}, by_finger);
    EXPECT_EQ(clip().frame(), 45);
    EXPECT_GT(value(kTail, 45), motions()[45].tail_angle + 0.05f);
    EXPECT_GT(value(kTail, 43), motions()[43].tail_angle);
    key(SDLK_z, KMOD_LCTRL);
  }
  // Beside the curve the pointer moves the time and nothing else.
  drag({editor_->on_plot(55).x, at.y}, {editor_->on_plot(75).x, at.y}, true);
  EXPECT_EQ(clip().frame(), 75);
  EXPECT_TRUE(clip().edits().empty());
}

TEST_P(TakeEditorTest, TheFishIsMovedAndTurned) {
  if (!editor_) return;
  go_to(80);
  const Vec2 centre = editor_->on_screen(kCentre);
  drag(centre, centre + Vec2{15, 20}, false);
  EXPECT_EQ(clip().edits().size(), 2u);
  EXPECT_GT(clip().motions()[80].centre.y, 205);
  EXPECT_GT(clip().motions()[75].centre.y, 200);
  EXPECT_EQ(clip().motions()[40].centre.y, 200);
  const Vec2 course = editor_->on_screen({Kind::dir, 0});
  drag(course, course + Vec2{0, 30}, true);
  EXPECT_GT(clip().motions()[80].dir_rad, 0.1f);
  key(SDLK_z, KMOD_LCTRL), key(SDLK_z, KMOD_LCTRL);
  EXPECT_TRUE(clip().edits().empty());
}

TEST_P(TakeEditorTest, BeforeShowsTheRecordingAndChangesNothing) {
  if (!editor_) return;
  go_to(45);
  const Vec2 head = editor_->on_screen(kHead);
  const std::vector<uint8_t> recorded = picture();
  drag(head, head + Vec2{10, 25}, false);
  EXPECT_NE(picture(), recorded);
  const std::vector<Edit> edits = clip().edits();
  tap(bar_button(3));
  EXPECT_TRUE(editor_->look().before);
  drag(editor_->on_screen(kHead), head, true);
  EXPECT_EQ(clip().edits().size(), edits.size());
  tap(bar_button(3));
  EXPECT_FALSE(editor_->look().before);
}

TEST_P(TakeEditorTest, ItPlaysAndStopsWhereItIsTouched) {
  if (!editor_) return;
  tap(bar_button(2));
  EXPECT_TRUE(editor_->playing());
  frames(30);
  const int64_t later = clip().frame();
  EXPECT_GT(later, 10);
  frames(30);
  EXPECT_GT(clip().frame(), later);
  key(SDLK_SPACE);
  EXPECT_FALSE(editor_->playing());
  const int64_t stopped = clip().frame();
  frames(30);
  EXPECT_EQ(clip().frame(), stopped);
}

TEST_P(TakeEditorTest, AFullDiskIsToldAndKeepsTheWindowOpen) {
  if (!editor_) return;
  go_to(45);
  const Vec2 tail = editor_->on_screen(kTail);
  drag(tail, tail + Vec2{0, -20}, true);
  disk_is_full_ = true;
  key(SDLK_q);
  EXPECT_TRUE(editor_->asking());
  key(SDLK_ESCAPE);
  EXPECT_FALSE(editor_->asking());
  disk_is_full_ = false;
  key(SDLK_q);
  EXPECT_EQ(saves_, 1);
  EXPECT_FALSE(editor_->asking());
  EXPECT_FALSE(frames(1));
}

TEST_P(TakeEditorTest, TheKeptVideoShowsTheFrameBesideTheCharacter) {
  if (!editor_) return;
  const TempDir dir;
  const std::string path = dir / "a.take.mkv";
  {
    VideoWriter writer(path, 960, 544, 30);  // the frame's number as a shade
    for (int n = 0; n < kFrames; ++n) writer.add(std::vector<uint8_t>(960 * 544 * 3, static_cast<uint8_t>(40 + n)));
    writer.finish();
  }
  EditedClip clip{motions(), {}, 30, 180, {960, 544}};
  clip.video = path, clip.video_first = 10;
  editor_.reset();
  editor_ = std::make_unique<TakeEditor>(*display_, std::move(clip), carp(), [](const std::vector<Edit>&) {});
  frames(3);
  EXPECT_EQ(editor_->video(), nullptr);
  const float whole = editor_->canvas().size.x;
  tap({whole * 6.5f / 8, 0.5f * editor_->canvas().corner.y});
  ASSERT_NE(editor_->video(), nullptr);
  const Area canvas = editor_->canvas();
  EXPECT_LT(canvas.size.x, 0.6f * whole);
  EXPECT_GT(editor_->on_plot(60).y, canvas.corner.y + canvas.size.y);  // nothing lies over the curves
  const auto settle = [&](int64_t frame) {
    for (int i = 0; i < 1000 && editor_->video()->shown() != frame && editor_->video()->problem().empty(); ++i)
      frames(1), SDL_Delay(2);
    frames(2);
  };
  const auto shade = [&] {
    const int x = static_cast<int>(canvas.size.x + 0.2f * canvas.size.x);
    const int y = size_.height - 1 - static_cast<int>(canvas.corner.y + 0.5f * canvas.size.y);
    return static_cast<int>(picture()[static_cast<std::size_t>((y * size_.width + x) * 4)]);
  };
  for (const int frame : {80, 81, 30, 140}) {
    go_to(frame);
    settle(frame);
    EXPECT_EQ(editor_->video()->problem(), "");
    EXPECT_NEAR(shade(), 40 + frame - 10, 2);
  }
  go_to(5);
  settle(5);
  EXPECT_EQ(editor_->video()->problem(), "a.take.mkv begins later");
  std::filesystem::remove(path);
  go_to(60);
  settle(60);
  EXPECT_EQ(editor_->video()->problem(), "a.take.mkv is not there: put it beside the take again");
  key(SDLK_v);
  EXPECT_EQ(editor_->video(), nullptr);
  EXPECT_EQ(editor_->canvas().size.x, whole);
}

class TakeEditorRows : public TakeEditorTest {};

// The last row of the side panel is on the screen and does what it says.
TEST_P(TakeEditorRows, EveryRowOfButtonsIsOnTheScreen) {
  if (!editor_) return;
  const float left = editor_->canvas().size.x, side = static_cast<float>(size_.width) - left;
  const int reach = clip().radius();
  int rows_with_effect = 0;
  for (float y = 20; y < static_cast<float>(size_.height); y += 24) {
    const std::size_t edits = clip().edits().size();
    const auto selected = clip().selected();
    tap({left + 0.15f * side, y});
    rows_with_effect += clip().edits().size() != edits || clip().selected() != selected ? 1 : 0;
  }
  EXPECT_GE(rows_with_effect, 6);
  EXPECT_LT(clip().radius(), reach);  // its minus is in the last row
}

INSTANTIATE_TEST_SUITE_P(Touch, TakeEditorTest, ::testing::Values(DisplaySize{800, 480}), test::size_name);
INSTANTIATE_TEST_SUITE_P(Sizes, TakeEditorRows, ::testing::Values(DisplaySize{960, 600}, DisplaySize{800, 480}),
                         test::size_name);

}  // namespace
}  // namespace nt
