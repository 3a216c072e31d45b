// SPDX-License-Identifier: Apache-2.0
// The program on a real X server without a screen (Xvfb), driven by a real pointer and keyboard (xdotool).
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include <opencv2/imgcodecs.hpp>

#include "core/base/vec2.h"
#include "tests/app/run_binary.h"

namespace nt::test {

class ScreenScript : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"xvfb-run", "xdotool", "ffmpeg"}) {
      const std::string there = std::string("command -v ") + program + " >/dev/null 2>&1";
      if (std::system(there.c_str()) != 0) GTEST_SKIP() << "no " << program;
    }
  }

  // Starts `neontetra ARGUMENTS` on a screen of 800x480 and runs `does`, a shell script with $program, and shot NAME for a
  // picture.
  Outcome on_screen(const std::string& arguments, const std::string& does) {
    std::ofstream(dir_ / "script.sh")
        << "shot() { ffmpeg -loglevel error -y -f x11grab -video_size 800x480 -i $DISPLAY -frames:v 1 " << (dir_ / "")
        << "$1.png </dev/null; }\n"
        << "timeout 60 " NEONTETRA_BINARY " " << arguments << " 2>" << (dir_ / "err")
        << " &\n"
           "program=$!\n"
           "window=$(timeout 20 xdotool search --sync --onlyvisible --name '^neontetra: ')\n"
           "xdotool windowfocus $window mousemove 5 300\n"
           "sleep 2\n"
        << does << "\nwait $program\n";
    const std::string command =
        "xvfb-run -a -s '-screen 0 800x480x24' bash " + (dir_ / "script.sh") + " >" + (dir_ / "out") + " 2>/dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    outcome.err = read_text(dir_ / "err");
    return outcome;
  }

  // Of the left part of the window between the bars; the buttons beside it show the same colours.
  cv::Mat picture(const std::string& name) const {
    const cv::Mat whole = cv::imread(dir_ / (name + ".png"));
    return whole.cols < 510 || whole.rows < 440 ? cv::Mat() : whole(cv::Rect(0, 56, 510, 384)).clone();
  }

  // The middle of all pixels of this colour.
  static std::optional<Vec2> find(const cv::Mat& bgr, cv::Vec3b colour) {
    double x = 0, y = 0, n = 0;
    for (int row = 0; row < bgr.rows; ++row) {
      for (int column = 0; column < bgr.cols; ++column) {
        if (cv::norm(bgr.at<cv::Vec3b>(row, column), colour) < 2) x += column, y += row, ++n;
      }
    }
    if (n < 20) return std::nullopt;
    return Vec2{static_cast<float>(x / n), static_cast<float>(y / n)};
  }

  TempDir dir_;
};

}  // namespace nt::test
