// SPDX-License-Identifier: Apache-2.0
// The window as a user has it: a real X server without a screen (Xvfb), a real pointer and keyboard (xdotool).
#include <gtest/gtest.h>

#include <cmath>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";

bool has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// A fish-like blob: a blunt head to the right, a thin tail.
void draw_fish(cv::Mat& frame, double x, double y, double length) {
  std::vector<cv::Point> outline;
  for (int side : {1, -1}) {
    for (int i = 0; i <= 40; ++i) {
      const double s = (side > 0 ? i : 40 - i) / 40.0;
      const double half = length * 0.16 * std::sqrt(s) * (1 - s) + 2;
      outline.emplace_back(static_cast<int>(x + length * (0.5 - s)), static_cast<int>(std::lround(y + side * half)));
    }
  }
  cv::fillPoly(frame, std::vector<std::vector<cv::Point>>{outline}, {30, 30, 30}, cv::LINE_AA);
}

// Two fish swim abreast: the large one above at y = 80, the small one below at y = 250.
void write_two_fish(const std::string& path, int frames) {
  cv::VideoWriter video(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {640, 320});
  ASSERT_TRUE(video.isOpened());
  for (int i = 0; i < frames; ++i) {
    cv::Mat frame(320, 640, CV_8UC3, cv::Scalar(220, 220, 220));
    const double x = 320 + 60 * std::sin(i * 0.05);
    draw_fish(frame, x, 80, 220);
    draw_fish(frame, x, 250, 150);
    video.write(frame);
  }
}

class Live : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"xvfb-run", "xdotool"})
      if (!has(program)) GTEST_SKIP() << "no " << program;
    write_two_fish(dir_ / "two.avi", 300);
  }

  // Runs live and, once its window is there, `does`: a shell script that has the window in $window and the program in
  // $program. What it prints is `out`; the exit code is the program's. A program that hangs is ended after 60 s.
  Outcome live(const std::string& arguments, const std::string& does) {
    std::ofstream(dir_ / "script.sh")
        << "timeout 60 " NEONTETRA_BINARY " live --character " << kCarp << " --record-to " << (dir_ / "rec") << " "
        << arguments << " 2>" << (dir_ / "err")
        << " &\n"
           "program=$!\n"
           "window=$(timeout 20 xdotool search --sync --onlyvisible --name '^neontetra$')\n"
           "xdotool windowfocus $window mousemove --window $window 5 5\n"
           "sleep 1\n"
        << does << "\nwait $program\n";
    const std::string command =
        "xvfb-run -a -s '-screen 0 1600x900x24' sh " + (dir_ / "script.sh") + " >" + (dir_ / "out") + " 2>/dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    outcome.out = read_text(dir_ / "out");
    outcome.err = read_text(dir_ / "err");
    return outcome;
  }

  double recorded_y(int number) const {
    const CsvTable rows(dir_ / ("rec-" + std::to_string(number) + ".csv"));
    for (std::size_t row = rows.rows(); row-- > 0;)
      if (rows.text(row, "status") == "ok") return *rows.number(row, "centre_y");
    ADD_FAILURE() << "no pose in recording " << number;
    return 0;
  }

  TempDir dir_;
};

TEST_F(Live, QEndsItWithExitCode0) {
  const Outcome run = live("--background backlit -c " + dir_ / "two.avi", "xdotool key q");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("dropped"), std::string::npos) << run.err;
}

TEST_F(Live, SpaceHoldsTheClipAndLetsItGoOn) {
  const Outcome run = live("--background vibe -c sim:frames=75,size=320x240",
                           "xdotool key space; sleep 5; kill -0 $program && echo held; xdotool key space");
  EXPECT_EQ(run.out, "held\n");  // 2.5 s of clip: without the pause it had ended
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

// On a colour for keying, alone, without lines: the corner of the recorded film has that colour and no other; c changes
// the character without a stop.
TEST_F(Live, AloneOnAColourWithTwoCharacters) {
  const Outcome run = live("--background backlit --layout alone --backdrop '#00ff00' --info-text '' --character " +
                               kCarp + " -c " + dir_ / "two.avi",
                           "xdotool key r; sleep 1; xdotool key c; sleep 1; xdotool key i c; sleep 0.5; xdotool key r; "
                           "sleep 0.3; xdotool key q");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  cv::VideoCapture video(dir_ / "rec-1.mp4");
  ASSERT_TRUE(video.isOpened());
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 640);
  cv::Mat frame, last;
  while (video.read(frame)) frame.copyTo(last);
  ASSERT_FALSE(last.empty());
  const cv::Vec3b corner = last.at<cv::Vec3b>(300, 20);
  EXPECT_LT(corner[0], 12);
  EXPECT_GT(corner[1], 240);
  EXPECT_LT(corner[2], 12);
  const cv::Vec3b fish = last.at<cv::Vec3b>(80, 320);
  EXPECT_LT(fish[1], 235);  // the character is there
}

// The working frame is the source here, and the window shows it pixel for pixel.
TEST_F(Live, TwoClicksOnALengthGiveTheScale) {
  const std::string click = " click 1; sleep 0.5; ";
  const Outcome run =
      live("--background backlit --scale-mm 100 -c " + dir_ / "two.avi",
           "xdotool mousemove --window $window 100 20" + click + "xdotool mousemove --window $window 102 20" +
               click +  // too near: the two begin anew
               "xdotool mousemove --window $window 100 20" + click + "xdotool mousemove --window $window 350 20" +
               click + "xdotool key r; sleep 2; xdotool key r q");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("scale: 2.500 pixels per millimetre"), std::string::npos) << run.err;
  const Outcome list = neontetra("takes --json " + dir_ / "rec-1.take");
  EXPECT_NE(list.out.find("\"px_per_mm\": 2.5"), std::string::npos) << list.out << list.err;
}

TEST_F(Live, AScaleByClicksNeedsTheCamerasPicture) {
  const Outcome run = neontetra("live --layout alone --scale-mm 100 --character " + kCarp + " -c " + dir_ / "two.avi");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--scale-points"), std::string::npos) << run.err;
}

TEST_F(Live, ClickSelectsAndRRecords) {
  const std::string record = "xdotool key r; sleep 2; xdotool key r; sleep 0.5;";
  const std::string click = "xdotool mousemove --window $window 320 250 click 1; sleep 1;";
  const Outcome run = live("--background backlit -c " + dir_ / "two.avi", record + click + record + "xdotool key q");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(recorded_y(1), 80, 15);  // automatic: the largest
  EXPECT_NEAR(recorded_y(2), 250, 15);
  for (const char* name : {"rec-1.mp4", "rec-2.mp4"}) {
    cv::VideoCapture video(dir_ / name);
    ASSERT_TRUE(video.isOpened()) << name;
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 1280);
    EXPECT_GT(video.get(cv::CAP_PROP_FRAME_COUNT), 5);
  }
}

}  // namespace
}  // namespace nt
