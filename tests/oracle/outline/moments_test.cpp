// SPDX-License-Identifier: Apache-2.0
// Moments of an outline against cv::moments of the polygon and, as the paper has it, PCA over the pixels inside.
#include "core/outline/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/fish_outline.h"

namespace {

using nt::test::FishOutline;

TEST(MomentsOracle, OfAFishInAnyDirection) {
  for (const float heading : {0.0f, 0.8f, 1.6f, 2.9f, -1.1f}) {
    const FishOutline fish({.bend = 0.7f, .heading = heading, .left_fin = true});
    const nt::Moments ours = nt::polygon_moments(fish.contour());
    std::vector<cv::Point2f> polygon;
    for (const nt::Vec2 p : fish.contour()) polygon.emplace_back(p.x, p.y);
    const cv::Moments theirs = cv::moments(polygon);
    EXPECT_NEAR(ours.area, theirs.m00, 1e-4 * theirs.m00);
    EXPECT_NEAR(ours.centroid.x, theirs.m10 / theirs.m00, 0.01);
    EXPECT_NEAR(ours.centroid.y, theirs.m01 / theirs.m00, 0.01);
    const double mean = (theirs.mu20 + theirs.mu02) / 2 / theirs.m00;
    const double spread = std::hypot((theirs.mu20 - theirs.mu02) / 2, theirs.mu11) / theirs.m00;
    EXPECT_NEAR(ours.major, std::sqrt(mean + spread), 0.01);
    EXPECT_NEAR(ours.minor, std::sqrt(mean - spread), 0.01);

    std::vector<cv::Point> inside;
    const cv::Rect box = cv::boundingRect(polygon);
    for (int y = box.y; y < box.br().y; ++y)
      for (int x = box.x; x < box.br().x; ++x)
        if (cv::pointPolygonTest(polygon, cv::Point2f(static_cast<float>(x), static_cast<float>(y)), false) >= 0)
          inside.emplace_back(x, y);
    cv::Mat samples(static_cast<int>(inside.size()), 2, CV_64F);
    for (int i = 0; i < samples.rows; ++i) {
      samples.at<double>(i, 0) = inside[static_cast<std::size_t>(i)].x;
      samples.at<double>(i, 1) = inside[static_cast<std::size_t>(i)].y;
    }
    const cv::PCA pca(samples, cv::Mat(), cv::PCA::DATA_AS_ROW);
    const double along =
        ours.axis.x * pca.eigenvectors.at<double>(0, 0) + ours.axis.y * pca.eigenvectors.at<double>(0, 1);
    EXPECT_GT(std::abs(along), std::cos(0.01)) << "within a hundredth of a radian";
    EXPECT_NEAR(ours.centroid.x, pca.mean.at<double>(0), 0.25);
    EXPECT_NEAR(ours.centroid.y, pca.mean.at<double>(1), 0.25);
    EXPECT_NEAR(ours.major, std::sqrt(pca.eigenvalues.at<double>(0)), 0.005 * ours.major);
  }
}

}  // namespace
