// SPDX-License-Identifier: Apache-2.0
// `neontetra character --edit` as a user has it: a real X server without a screen (Xvfb), a real pointer and keyboard.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>

#include "app/author/character_file.h"
#include "tests/app/screen_script.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";

class EditWindow : public test::ScreenScript {
 protected:
  void SetUp() override {
    ScreenScript::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(neontetra("character " + kCarp + " --out " + character_).exit_code, 0);
  }
  Outcome edit(const std::string& does) { return on_screen("character --edit " + character_, does); }

  Vec2 listed(const std::string& point) const {
    const Outcome run = neontetra("character " + character_ + " --list --json");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto at = nlohmann::json::parse(run.out)["points"][point];
    return {at["x"], at["y"]};
  }

  std::string character_ = dir_ / "carp.ntchar";
};

TEST_F(EditWindow, ADraggedTailIsSavedUndoneAndSwims) {
  // Where the tail is drawn is read off the screen; the dot is the only thing of that blue.
  ASSERT_EQ(edit("shot before; xdotool key q").exit_code, 0);
  const std::optional<Vec2> tail = find(picture("before"), {0xFF, 0x6B, 0x2F});
  ASSERT_TRUE(tail);
  const Vec2 before = listed("tail");
  const std::string x = std::to_string(std::lround(tail->x)), y = std::to_string(std::lround(tail->y) + 56);
  const Outcome run =
      edit("xdotool mousemove " + x + " " + y +
           " mousedown 1; sleep 0.3\n"
           "for i in 1 2 3 4 5 6; do xdotool mousemove_relative 5 5; sleep 0.1; done\n"
           "xdotool mouseup 1; sleep 0.3; shot dragged\n"
           "xdotool key ctrl+s; sleep 0.7; cp " +
           character_ + " " + (dir_ / "dragged.ntchar") +
           "\n"
           "xdotool key space; sleep 1; shot swim1; sleep 0.7; shot swim2; xdotool key space; sleep 0.3\n"
           "xdotool key ctrl+z; sleep 0.3; shot undone; xdotool key ctrl+s; sleep 0.7; xdotool key q");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.error_lines(), 1) << run.err;  // which display it is
  EXPECT_EQ(run.err.rfind("display: ", 0), 0u) << run.err;

  const std::optional<Vec2> dragged = find(picture("dragged"), {0xFF, 0x6B, 0x2F});
  ASSERT_TRUE(dragged);
  EXPECT_NEAR(dragged->x, tail->x + 30, 2);
  EXPECT_NEAR(dragged->y, tail->y + 30, 2);
  EXPECT_NEAR(length(listed("tail") - before), 0, 0.2);  // undone, then saved
  character_ = dir_ / "dragged.ntchar";
  const Vec2 moved = listed("tail") - before;
  EXPECT_GT(moved.x, 30);  // figure pixels are smaller than the screen's
  EXPECT_NEAR(moved.x, moved.y, 3);

  EXPECT_GT(cv::norm(picture("swim1"), picture("swim2"), cv::NORM_L1), 100'000);
  EXPECT_GT(cv::norm(picture("swim1"), picture("dragged"), cv::NORM_L1), 100'000);
  EXPECT_TRUE(find(picture("undone"), {0xFF, 0x6B, 0x2F}));
}

TEST_F(EditWindow, UnsavedChangesAreAskedAbout) {
  // M: mirror. Q asks; the middle button leaves without saving.
  const Outcome run = edit(
      "xdotool key m; sleep 0.3; xdotool key q; sleep 0.5; kill -0 $program && shot asked\n"
      "xdotool mousemove 400 258 sleep 0.2 click 1");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(picture("asked").empty());
  EXPECT_FALSE(std::filesystem::exists(dir_ / "carp.corrections.txt"));
}

TEST_F(EditWindow, ASwimmersLatticeIsMadeAnewForWhatIsSaved) {
  const std::string whale = NEONTETRA_ASSETS "/characters/whale.glb";
  ASSERT_EQ(neontetra("character " + whale + " --lattice --vertices 150 --out " + character_).exit_code, 0);
  const Outcome run = edit("xdotool key m; sleep 0.3; xdotool key ctrl+s; sleep 2; xdotool key q");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(dir_ / "carp.corrections.txt"));
  EXPECT_TRUE(LoadedCharacter(character_, Limits{}).character().lattice.present());
}

TEST(EditWithoutADisplay, SaysSoInOneLine) {
  const TempDir dir;
  ASSERT_EQ(neontetra("character " + kCarp + " --out " + (dir / "c.ntchar")).exit_code, 0);
  const std::string command = "character --edit " + (dir / "c.ntchar");
  ::unsetenv("WAYLAND_DISPLAY");
  const char* display = std::getenv("DISPLAY");
  const std::string before = display != nullptr ? display : "";
  ::unsetenv("DISPLAY");
  const Outcome run = neontetra(command);
  if (!before.empty()) ::setenv("DISPLAY", before.c_str(), 1);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.error_lines(), 1) << run.err;
  EXPECT_NE(run.err.find("no window"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace nt
