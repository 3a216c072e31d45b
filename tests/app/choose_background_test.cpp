// SPDX-License-Identifier: Apache-2.0
#include "app/author/choose_background.h"

#include <gtest/gtest.h>

#include <functional>

#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

// A clip of 30 frames: a dark ellipse at `place(frame)` (nowhere when x < 0) on an even bright field with noise;
// as spread_small() gives them.
std::vector<cv::Mat> clip(const std::function<cv::Point(int)>& place) {
  cv::RNG random(7);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 30; ++i) {
    cv::Mat noise(180, 320, CV_8U);
    random.fill(noise, cv::RNG::NORMAL, 200, 4);
    const cv::Point at = place(i);
    if (at.x >= 0) cv::ellipse(noise, at, {40, 8}, 0, 0, 360, cv::Scalar(30), cv::FILLED);
    frames.emplace_back();
    noise.convertTo(frames.back(), CV_32F);
  }
  return frames;
}

TEST(ChooseBackground, AFishThatHoldsItsPlaceOnAnEvenFieldIsBacklit) {
  const BackgroundChoice choice = choose_background(clip([](int i) { return cv::Point(160 + i % 3, 90); }));
  EXPECT_EQ(choice.kind, BackgroundKind::backlit) << choice.why;
  EXPECT_NE(choice.why.find("bright field"), std::string::npos) << choice.why;
}

TEST(ChooseBackground, AFishThatLeavesLateNeedsTheMedian) {
  const BackgroundChoice choice =
      choose_background(clip([](int i) { return i < 10 ? cv::Point(80, 90) : cv::Point(100 + 6 * i, 50); }));
  EXPECT_EQ(choice.kind, BackgroundKind::still) << choice.why;
}

TEST(ChooseBackground, AnEmptyFirstFrameIsForVibe) {
  const BackgroundChoice choice =
      choose_background(clip([](int i) { return i < 10 ? cv::Point(-1, 0) : cv::Point(120, 90); }));
  EXPECT_EQ(choice.kind, BackgroundKind::vibe) << choice.why;
}

TEST(ChooseBackground, AFishThatSwimsOnIsForVibe) {
  const BackgroundChoice choice = choose_background(clip([](int i) { return cv::Point(45 + 8 * i, 40 + 3 * i); }));
  EXPECT_EQ(choice.kind, BackgroundKind::vibe) << choice.why;
}

TEST(ChooseBackground, WithoutALookAheadItIsVibe) { EXPECT_EQ(choose_background({}).kind, BackgroundKind::vibe); }

}  // namespace
}  // namespace nt
