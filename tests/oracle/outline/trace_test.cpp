// SPDX-License-Identifier: Apache-2.0
// The traced border against cv::findContours: the same set of points, and filled it is the component without holes.
#include "core/outline/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tests/oracle/masks.h"

namespace {

using Points = std::vector<cv::Point>;

Points trace(const cv::Mat& mask, cv::Point origin) {
  std::vector<nt::Vec2> out(static_cast<std::size_t>(4 * mask.total() + 8));
  const nt::test::OwnedMask bits(mask);
  const int n = nt::trace_outline(bits.view(), origin.x, origin.y, out);
  Points points;
  for (int i = 0; i < n; ++i) {
    const nt::Vec2 p = out[static_cast<std::size_t>(i)];
    points.emplace_back(static_cast<int>(p.x) - origin.x, static_cast<int>(p.y) - origin.y);
  }
  return points;
}

// The component that holds the first set pixel in reading order.
cv::Mat first_component(const cv::Mat& mask) {
  cv::Mat labels;
  cv::connectedComponents(mask, labels, 8);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<uint8_t>(y, x) != 0) return labels == labels.at<int>(y, x);
    }
  }
  return mask.clone();
}

std::set<std::pair<int, int>> set_of(const Points& points) {
  std::set<std::pair<int, int>> out;
  for (const cv::Point p : points) out.emplace(p.x, p.y);
  return out;
}

void expect_closed_chain(const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point step = points[(i + 1) % points.size()] - points[i];
    ASSERT_LE(std::max(std::abs(step.x), std::abs(step.y)), 1);
    ASSERT_TRUE(points.size() == 1 || step != cv::Point(0, 0)) << "a point is repeated";
  }
}

void compare(const cv::Mat& mask) {
  const Points ours = trace(mask, {0, 0});
  const cv::Mat component = first_component(mask);
  std::vector<Points> theirs;
  cv::findContours(component, theirs, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  if (theirs.empty()) {
    EXPECT_TRUE(ours.empty());
    return;
  }
  ASSERT_EQ(theirs.size(), 1u);
  EXPECT_EQ(set_of(ours), set_of(theirs[0]));
  EXPECT_EQ(ours.size(), theirs[0].size());
  expect_closed_chain(ours);

  cv::Mat filled(mask.size(), CV_8U, cv::Scalar(0)), want = filled.clone();
  cv::drawContours(filled, std::vector<Points>{ours}, 0, 255, cv::FILLED);
  cv::drawContours(want, theirs, 0, 255, cv::FILLED);
  EXPECT_EQ(cv::countNonZero(filled != want), 0);
  // Clockwise on the screen: with y down the shoelace sum is positive.
  const bool has_area = cv::countNonZero(filled) > static_cast<int>(ours.size());
  EXPECT_TRUE(!has_area || cv::contourArea(ours, true) > 0);
}

}  // namespace

TEST(TraceOracle, Blobs) {
  cv::RNG rng(7);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (int i = 0; i < 20; ++i) compare(nt::test::blob_mask(size, 3, rng));
  }
}

TEST(TraceOracle, Noise) {
  cv::RNG rng(8);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (const double share : {0.0, 0.3, 0.6, 0.9, 1.0}) compare(nt::test::noise_mask(size, share, rng));
  }
}

TEST(TraceOracle, ThinLinesAreWalkedOutAndBack) {
  cv::Mat mask(40, 100, CV_8U, cv::Scalar(0));
  cv::line(mask, {5, 20}, {90, 20}, 255);
  cv::ellipse(mask, {30, 20}, {15, 8}, 0, 0, 360, 255, cv::FILLED);
  compare(mask);
}

TEST(TraceOracle, AddsTheOrigin) {
  cv::Mat mask(10, 10, CV_8U, cv::Scalar(0));
  mask(cv::Rect(3, 4, 4, 3)) = 255;
  std::vector<nt::Vec2> out(64);
  const nt::test::OwnedMask bits(mask);
  ASSERT_EQ(nt::trace_outline(bits.view(), 100, 200, out), 10);
  EXPECT_EQ(out[0].x, 103);
  EXPECT_EQ(out[0].y, 204);
  EXPECT_EQ(nt::trace_outline(bits.view(), 0, 0, std::span(out).first(9)), -1) << "too small";
}
