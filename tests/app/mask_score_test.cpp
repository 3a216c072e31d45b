// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/masks/mask_score.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

TEST(MaskScore, CountsAsCdnetDoes) {
  // Foreground, shadow, unknown, outside, background; each once called foreground and once not.
  const cv::Mat truth = (cv::Mat_<uint8_t>(2, 6) << 255, 255, 50, 170, 85, 0, 255, 255, 50, 170, 85, 0);
  const cv::Mat mask = (cv::Mat_<uint8_t>(2, 6) << 1, 255, 255, 255, 255, 255, 0, 255, 0, 0, 0, 0);
  MaskScore score;
  score.add(mask, truth);
  EXPECT_EQ(score.found, 3);
  EXPECT_EQ(score.invented, 2) << "shadow and background";
  EXPECT_EQ(score.missed, 1);
  EXPECT_DOUBLE_EQ(score.precision(), 3.0 / 5);
  EXPECT_DOUBLE_EQ(score.recall(), 3.0 / 4);
  EXPECT_DOUBLE_EQ(score.f_measure(), 2 * 0.6 * 0.75 / (0.6 + 0.75));
  MaskScore both;
  both.add(score), both.add(score);
  EXPECT_EQ(both.frames, 2);
  EXPECT_DOUBLE_EQ(both.f_measure(), score.f_measure());
}

TEST(MaskScore, NothingJudgedIsNothingAchieved) {
  MaskScore score;
  EXPECT_EQ(score.f_measure(), 0);
  score.add(cv::Mat::zeros(3, 3, CV_8U), cv::Mat::zeros(3, 3, CV_8U));
  EXPECT_EQ(score.f_measure(), 0);
  EXPECT_EQ(score.precision(), 0);
  EXPECT_EQ(score.recall(), 0);
}

}  // namespace
}  // namespace nt
