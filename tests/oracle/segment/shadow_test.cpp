// SPDX-License-Identifier: Apache-2.0
// Otsu's threshold against cv::threshold with THRESH_OTSU.
#include "core/segment/shadow.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace {

std::array<int, 256> histogram_of(const cv::Mat& grey) {
  std::array<int, 256> h{};
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) ++h[grey.at<uint8_t>(y, x)];
  }
  return h;
}

// Two bumps of grey levels, as a fish and its shadow.
cv::Mat two_classes(double low, double high, double spread, cv::RNG& rng) {
  cv::Mat a(60, 80, CV_8U), b(60, 50, CV_8U), both;
  rng.fill(a, cv::RNG::NORMAL, low, spread);
  rng.fill(b, cv::RNG::NORMAL, high, spread);
  cv::hconcat(a, b, both);
  return both;
}

}  // namespace

TEST(OtsuOracle, TheSameThreshold) {
  cv::RNG rng(5);
  for (int i = 0; i < 50; ++i) {
    const cv::Mat grey = two_classes(rng.uniform(20, 100), rng.uniform(110, 230), rng.uniform(2, 30), rng);
    cv::Mat unused;
    const double theirs = cv::threshold(grey, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    EXPECT_EQ(nt::otsu(histogram_of(grey)).threshold, static_cast<int>(theirs));
  }
}

TEST(OtsuOracle, MeansAndSeparationAreThoseOfTheClasses) {
  cv::RNG rng(6);
  const cv::Mat grey = two_classes(60, 180, 15, rng);
  const nt::OtsuSplit split = nt::otsu(histogram_of(grey));
  const cv::Mat low = grey <= split.threshold;
  EXPECT_NEAR(split.low_mean, cv::mean(grey, low)[0], 1e-2);
  EXPECT_NEAR(split.high_mean, cv::mean(grey, ~low)[0], 1e-2);

  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  const double w = static_cast<double>(cv::countNonZero(low)) / static_cast<double>(grey.total());
  const double gap = split.high_mean - split.low_mean;
  EXPECT_NEAR(split.eta, w * (1 - w) * gap * gap / (deviation[0] * deviation[0]), 1e-3);
}
