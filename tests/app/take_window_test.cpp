// SPDX-License-Identifier: Apache-2.0
// `neontetra edit TAKE --character FILE` as a user has it: a real X server without a screen, a real pointer and keyboard.
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "app/take/edited.h"
#include "tests/app/screen_script.h"

namespace nt {
namespace {

class TakeWindow : public test::ScreenScript {
 protected:
  void SetUp() override {
    ScreenScript::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(neontetra("character " NEONTETRA_ASSETS "/characters/carp.png --out " + character_).exit_code, 0);
    ASSERT_EQ(neontetra("capture --camera sim:scene=turns,seed=2 --frames 220 --take " + take_).exit_code, 0);
  }
  Outcome edit(const std::string& does) { return on_screen("edit " + take_ + " --character " + character_, does); }

  // Dots of a fin's green, the largest first: the selected one.
  static std::optional<Vec2> largest_green(const cv::Mat& bgr) {
    cv::Mat mask, labels, stats, centroids;
    cv::inRange(bgr, cv::Scalar(0x4A - 3, 0xB0 - 3, 0x23 - 3), cv::Scalar(0x4A + 3, 0xB0 + 3, 0x23 + 3), mask);
    int best = 0, area = 30;
    for (int i = 1; i < cv::connectedComponentsWithStats(mask, labels, stats, centroids); ++i)
      if (stats.at<int>(i, cv::CC_STAT_AREA) > area) best = i, area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (best == 0) return std::nullopt;
    return Vec2{static_cast<float>(centroids.at<double>(best, 0)), static_cast<float>(centroids.at<double>(best, 1))};
  }
  std::vector<Motion> motions(bool edits) const { return load_take(take_, -1, edits).clip.motions; }

  std::string character_ = dir_ / "carp.ntchar", take_ = dir_ / "t.take";
};

TEST_F(TakeWindow, AFinIsDraggedItsNeighboursFollowAndItIsUndoneSavedAndReopened) {
  // 4 x 10 frames on; the left fin's curve is chosen by its button.
  const std::string there =
      "xdotool mousemove 560 184 click 1; sleep 0.3; for i in 1 2 3 4; do xdotool key shift+Right; done; sleep 0.5\n";
  ASSERT_EQ(edit(there + "shot before; xdotool key q").exit_code, 0);
  EXPECT_TRUE(load_take(take_, -1, true).clip.motions.size() == 220);
  const std::optional<Vec2> tip = largest_green(picture("before"));
  ASSERT_TRUE(tip);
  const std::string x = std::to_string(std::lround(tip->x)), y = std::to_string(std::lround(tip->y) + 56);
  const std::string drag = "xdotool mousemove " + x + " " + y +
                           " mousedown 1; sleep 0.3\n"
                           "for i in 1 2 3 4 5 6; do xdotool mousemove_relative -- -3 5; sleep 0.1; done\n"
                           "shot held; xdotool mouseup 1; sleep 0.3\n";
  const Outcome run = edit(there + drag +
                           "xdotool key ctrl+z; sleep 0.4; shot undone; xdotool key ctrl+y; sleep 0.3; "
                           "xdotool key ctrl+s; sleep 0.5; xdotool key q");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.error_lines(), 1) << run.err;  // which display it is
  EXPECT_EQ(run.err.rfind("display: ", 0), 0u) << run.err;
  EXPECT_GT(cv::norm(picture("held"), picture("before"), cv::NORM_L1), 50'000);

  const std::string list = neontetra("edit " + take_ + " --list").out;
  ASSERT_EQ(list.rfind("set l_fin_angle ", 0), 0u) << list;
  const auto frame = static_cast<std::size_t>(std::stoi(list.substr(16)));
  const std::vector<Motion> before = motions(false), after = motions(true);
  const float moved = after[frame].l_fin_angle - before[frame].l_fin_angle;
  EXPECT_GT(std::abs(moved), 0.1f);
  int along = 0, elsewhere = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool changed = after[i].l_fin_angle != before[i].l_fin_angle;
    along += changed ? 1 : 0;
    elsewhere += changed && std::abs(static_cast<double>(i) - static_cast<double>(frame)) > 60 ? 1 : 0;
    EXPECT_EQ(after[i].r_fin_angle, before[i].r_fin_angle);
  }
  EXPECT_GT(along, 3);
  EXPECT_EQ(elsewhere, 0);

  // It is there again, and undo takes it away for good.
  ASSERT_EQ(edit(there + "shot again; xdotool key ctrl+z; sleep 1.2; xdotool key q").exit_code, 0);
  EXPECT_LT(cv::norm(picture("again"), picture("held"), cv::NORM_L1),
            cv::norm(picture("before"), picture("held"), cv::NORM_L1));
  EXPECT_EQ(neontetra("edit " + take_ + " --list").out, "");
}

TEST_F(TakeWindow, ATakeThatIsOpenIsRefusedElsewhere) {
  const Outcome run = edit(NEONTETRA_BINARY " edit " + take_ + " --clear 2>" + (dir_ / "second") + "; echo $? >>" +
                           (dir_ / "second") + "; xdotool key q");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string second = read_text(dir_ / "second");
  EXPECT_NE(second.find("in use by another program"), std::string::npos) << second;
  EXPECT_NE(second.find("\n1\n"), std::string::npos) << second;
}

}  // namespace
}  // namespace nt
