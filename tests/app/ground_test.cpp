// SPDX-License-Identifier: Apache-2.0
#include "app/author/ground.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/author/figure.h"

namespace nt {
namespace {

double overlap(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) / static_cast<double>(std::max(1, cv::countNonZero(a | b)));
}

// An outlined fish on paper whose light falls off to one corner and is yellowish, with grain.
struct Photo {
  cv::Mat rgba, truth;
};
Photo photo_of_paper() {
  Photo p;
  p.truth = cv::Mat::zeros(480, 640, CV_8U);
  cv::ellipse(p.truth, {300, 240}, {180, 80}, 0, 0, 360, 255, cv::FILLED);
  const std::vector<cv::Point> tail{{460, 240}, {560, 170}, {545, 240}, {560, 310}};
  cv::fillPoly(p.truth, std::vector<std::vector<cv::Point>>{tail}, 255);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(p.truth, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat ink = cv::Mat::zeros(p.truth.size(), CV_8U);
  cv::drawContours(ink, contours, -1, 255, 5);
  p.truth |= ink;
  p.rgba.create(p.truth.size(), CV_8UC4);
  cv::RNG random(3);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double light = 1 - 0.45 * (x / 640.0) * (y / 480.0) + random.gaussian(0.012);
      const bool drawn = ink.at<uchar>(y, x) != 0;
      const double r = drawn ? 60 : 225, g = drawn ? 50 : 215, b = drawn ? 110 : 200;
      p.rgba.at<cv::Vec4b>(y, x) = {cv::saturate_cast<uchar>(r * light), cv::saturate_cast<uchar>(g * light),
                                    cv::saturate_cast<uchar>(b * light), 255};
    }
  }
  return p;
}

TEST(Ground, AnOutlinedFigureOnUnevenlyLitPaperIsCutOutWhole) {
  const Photo photo = photo_of_paper();
  const Ground ground = remove_ground(photo.rgba);
  EXPECT_TRUE(ground.paper);
  EXPECT_GT(overlap(ground.mask, photo.truth), 0.96);
}

TEST(Ground, ThePaperBecomesWhiteEverywhere) {
  const Photo photo = photo_of_paper();
  const Ground ground = remove_ground(photo.rgba);
  for (const cv::Rect corner : {cv::Rect(0, 0, 60, 60), cv::Rect(580, 420, 60, 60), cv::Rect(270, 220, 40, 40)}) {
    const cv::Scalar mean = cv::mean(ground.pixels(corner));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], 250, 9) << corner.x;
  }
}

TEST(Ground, AColouredGroundIsNoPaperAndKeepsItsColours) {
  cv::Mat picture(300, 500, CV_8UC4, cv::Scalar(40, 120, 190, 255));
  cv::ellipse(picture, {250, 150}, {150, 60}, 0, 0, 360, cv::Scalar(230, 160, 60, 255), cv::FILLED);
  const Ground ground = remove_ground(picture);
  EXPECT_FALSE(ground.paper);
  EXPECT_EQ(cv::norm(ground.pixels, picture, cv::NORM_INF), 0);
  cv::Mat truth = cv::Mat::zeros(300, 500, CV_8U);
  cv::ellipse(truth, {250, 150}, {150, 60}, 0, 0, 360, 255, cv::FILLED);
  EXPECT_GT(overlap(ground.mask, truth), 0.95);
}

TEST(Ground, AChildsDrawingOnPaperIsWhatItsMaskSays) {
  const std::string folder = std::string(NEONTETRA_SHARED_DATA) + "/drawings/";
  if (!std::filesystem::exists(folder + "handdrawn_char1_mask.png")) GTEST_SKIP() << "no shared data";
  const cv::Mat truth = cv::imread(folder + "handdrawn_char1_mask.png", cv::IMREAD_GRAYSCALE) >= 128;
  cv::Mat picture;
  cv::cvtColor(cv::imread(folder + "handdrawn_char1_texture.png", cv::IMREAD_COLOR), picture, cv::COLOR_BGR2RGBA);
  const Ground ground = remove_ground(picture);
  EXPECT_TRUE(ground.paper);
  ASSERT_EQ(ground.mask.size(), truth.size());
  const double iou = overlap(ground.mask, truth);
  RecordProperty("iou_percent", static_cast<int>(100 * iou));
  std::printf("intersection over union %.3f\n", iou);
  EXPECT_GT(iou, 0.93);
}

}  // namespace
}  // namespace nt
