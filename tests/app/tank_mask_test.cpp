// SPDX-License-Identifier: Apache-2.0
#include "app/tank_mask.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/app/run_binary.h"

namespace nt {
namespace {

// A source of 400 x 200 pixels, worked on at half its size.
CameraInfo info() {
  CameraInfo info;
  info.name = "clip";
  info.source_width = 400, info.source_height = 200, info.width = 200, info.height = 100;
  return info;
}

TEST(TankMask, WithoutOptionsThereIsNone) { EXPECT_TRUE(tank_mask({}, info()).empty()); }

TEST(TankMask, ARoiIsInSharesOfThePicture) {
  AreaOptions area;
  area.roi = RoiOption{0.25, 0.5, 0.5, 0.5};
  const cv::Mat mask = tank_mask(area, info());
  ASSERT_EQ(mask.size(), cv::Size(200, 100));
  EXPECT_EQ(cv::countNonZero(mask), 100 * 50);
  EXPECT_EQ(mask.at<uint8_t>(50, 50), 255);
  EXPECT_EQ(mask.at<uint8_t>(49, 50), 0);
  EXPECT_EQ(mask.at<uint8_t>(99, 150), 0);
}

TEST(TankMask, CornersAreInPixelsOfTheSource) {
  AreaOptions area;
  area.polygon = {{0, 0}, {200, 0}, {200, 100}, {0, 100}};
  const cv::Mat mask = tank_mask(area, info());
  EXPECT_NEAR(cv::countNonZero(mask), 100 * 50, 200);
  EXPECT_EQ(mask.at<uint8_t>(25, 50), 255);
  EXPECT_EQ(mask.at<uint8_t>(75, 50), 0);
}

TEST(TankMask, APictureIsFittedAndBlackIsOutside) {
  const TempDir dir;
  cv::Mat picture(50, 100, CV_8U, cv::Scalar(0));
  picture(cv::Rect(50, 0, 50, 50)) = 255;
  cv::imwrite(dir / "tank.png", picture);
  AreaOptions area;
  area.picture = dir / "tank.png";
  const cv::Mat mask = tank_mask(area, info());
  EXPECT_NEAR(cv::countNonZero(mask), 100 * 100, 200);
  EXPECT_EQ(mask.at<uint8_t>(50, 150), 255);
  area.roi = RoiOption{0, 0, 0.75, 1};
  EXPECT_NEAR(cv::countNonZero(tank_mask(area, info())), 50 * 100, 200) << "what lies in both";
}

TEST(TankMask, WhatCannotBeIsRefused) {
  AreaOptions outside;
  outside.polygon = {{0, 0}, {500, 0}, {0, 100}};
  EXPECT_THROW(tank_mask(outside, info()), UserError);
  AreaOptions missing;
  missing.picture = "/nowhere.png";
  EXPECT_THROW(tank_mask(missing, info()), UserError);
  AreaOptions nothing;
  nothing.polygon = {{0, 0}, {10, 0}, {0, 10}};
  nothing.roi = RoiOption{0.5, 0.5, 0.5, 0.5};
  EXPECT_THROW(tank_mask(nothing, info()), UserError);
}

TEST(TankMask, NothingOutsideIsAFish) {
  const std::string tank = "capture -c sim:frames=150,size=480x272 --background vibe --csv - ";
  const auto poses = [&](const std::string& more) {
    const Outcome run = neontetra(tank + more);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    int count = 0;
    for (std::size_t at = 0; (at = run.out.find(",ok,", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const int all = poses("");
  ASSERT_GT(all, 50);
  EXPECT_EQ(poses("--roi 0,0,1,1"), all);
  EXPECT_EQ(poses("--tank 0,0 479,0 479,271 0,271"), all);
  EXPECT_EQ(poses("--roi 0,0,0.02,0.02"), 0);
  EXPECT_EQ(poses("--tank 0,0 12,0 12,12"), 0);
  EXPECT_EQ(poses("--min-size 50000"), 0);
  EXPECT_EQ(poses("--max-size 100"), 0);
  EXPECT_EQ(poses("--min-size 100 --max-size 50000"), all);
}

TEST(TankMask, WrongOptionsAreOneLine) {
  for (const char* wrong : {"--roi 0,0,1", "--roi 0.5,0,0.6,1", "--roi 0,0,0,1", "--roi a,0,1,1", "--tank 1,2 3,4",
                            "--tank 1,2 3,4 5", "--tank 1,2 3,4 9000,5", "--min-size 0", "--max-size x",
                            "--min-size 500 --max-size 100", "--roi 0,0,0.0001,0.0001"}) {
    const Outcome run = neontetra(std::string("capture -c sim:frames=2,size=320x240 --background vibe ") + wrong);
    EXPECT_EQ(run.exit_code, 2) << wrong << ": " << run.err;
    EXPECT_EQ(run.error_lines(), 1) << wrong << ": " << run.err;
  }
  const Outcome missing = neontetra("capture -c sim:frames=2 --background vibe --tank /nowhere.png");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.error_lines(), 1);
}

}  // namespace
}  // namespace nt
