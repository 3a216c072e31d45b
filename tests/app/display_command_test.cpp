// SPDX-License-Identifier: Apache-2.0
// --display and --rotation as a user has them: on a real X server without a screen (Xvfb), and where there is none.
#include <filesystem>

#include <opencv2/imgproc.hpp>

#include "tests/app/screen_script.h"

namespace nt {
namespace {

const std::string kLive =
    "live -c sim:scene=ghost,frames=40 --fps 40 --character " NEONTETRA_ASSETS "/characters/carp.png ";
const std::string kNoScreen = "env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER ";

Outcome without_screen(const std::string& arguments) {
  const TempDir dir;
  const int status = std::system((kNoScreen + NEONTETRA_BINARY " " + arguments + " 2>" + (dir / "err")).c_str());
  Outcome outcome;
  outcome.exit_code = WEXITSTATUS(status);
  outcome.err = read_text(dir / "err");
  return outcome;
}

TEST(DisplayCommand, WhatNobodySeesIsSaidAndTheRestRuns) {
  const Outcome egl = without_screen(kLive + "--display egl");
  EXPECT_EQ(egl.exit_code, 0) << egl.err;
  EXPECT_NE(egl.err.find("display: EGL surfaceless, 1920x544, "), std::string::npos) << egl.err;
  const Outcome null = without_screen(kLive + "--display null");
  EXPECT_EQ(null.exit_code, 0) << null.err;
  EXPECT_NE(null.err.find("display: null, 1920x544, nothing is drawn\n"), std::string::npos) << null.err;
}

TEST(DisplayCommand, AForcedDisplayThatCannotBeHadIsOneLine) {
  const Outcome window = without_screen(kLive + "--display window");
  EXPECT_EQ(window.exit_code, 1);
  EXPECT_EQ(window.error_lines(), 1);
  EXPECT_NE(window.err.find("no window: there is no display"), std::string::npos) << window.err;
  if (std::filesystem::exists("/dev/dri/card0")) GTEST_SKIP() << "this machine has a screen for KMS";
  const Outcome kms = without_screen(kLive + "--display kms");
  EXPECT_EQ(kms.exit_code, 1);
  EXPECT_EQ(kms.error_lines(), 1);
  EXPECT_NE(kms.err.find("no screen by KMS"), std::string::npos) << kms.err;
  EXPECT_NE(kms.err.find("start from a text console"), std::string::npos) << kms.err;
}

class RotatedWindow : public test::ScreenScript {
 protected:
  // The window of a drag, whose background and mesh stand still, turned so far.
  cv::Mat shown(int degrees) {
    const std::string name = "turned" + std::to_string(degrees);
    const Outcome outcome =
        on_screen("markers --drag --mesh " NEONTETRA_ASSETS "/characters/whale.glb --fullscreen --rotation " +
                      std::to_string(degrees),
                  "sleep 1; shot " + name + "; xdotool key q");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(
        outcome.err.find("display: SDL2 window (x11), " + std::string(degrees % 180 == 0 ? "800x480" : "480x800")),
        std::string::npos)
        << outcome.err;
    return cv::imread(dir_ / (name + ".png"));
  }
};

TEST_F(RotatedWindow, ShowsTheSamePictureUpsideDown) {
  const cv::Mat upright = shown(0), turned = shown(180);
  ASSERT_FALSE(upright.empty() || turned.empty());
  cv::Mat back;
  cv::rotate(turned, back, cv::ROTATE_180);
  cv::Mat difference;
  cv::absdiff(upright, back, difference);
  cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
  cv::Mat plain, picture;
  cv::cvtColor(upright, picture, cv::COLOR_BGR2GRAY);
  cv::absdiff(picture, picture.at<uint8_t>(picture.rows / 2, 4), plain);
  EXPECT_GT(cv::countNonZero(plain > 20), 5000);       // there is something to see
  EXPECT_LT(cv::countNonZero(difference > 40), 1000);  // the pointer, and edges
}

}  // namespace
}  // namespace nt
