// SPDX-License-Identifier: Apache-2.0
// The warp against cv::warpAffine, and the motion estimate against OpenCV's own chain for it.
#include "core/stabilise/warp.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "core/stabilise/stabiliser.h"
#include "platform/sim/tank.h"
#include "platform/sim/tank_hand.h"
#include "tests/support/block.h"

namespace {

cv::Mat copy_of(const nt::LumaView& luma) {
  return cv::Mat(luma.height, luma.width, CV_8U, const_cast<uint8_t*>(luma.data), static_cast<std::size_t>(luma.stride))
      .clone();
}
nt::LumaView view_of(const cv::Mat& m) { return {m.data, m.cols, m.rows, static_cast<std::ptrdiff_t>(m.step[0])}; }

TEST(WarpOracle, IsWarpAffine) {
  nt::Tank tank({.width = 320, .height = 180});
  const cv::Mat from = copy_of(tank.render_next());
  for (const nt::Similarity t : {nt::Similarity{1, 0, 3.25, -2.5}, nt::Similarity{1.02, 0.03, -4.1, 2.7},
                                 nt::Similarity{0.97, -0.05, 6.6, 9.3}, nt::Similarity{1.1, 0.1, -20, 3}}) {
    const cv::Mat fill(from.size(), CV_8U, cv::Scalar(0));
    cv::Mat ours(from.size(), CV_8U), theirs, known;
    nt::warp_luma(view_of(from), t, view_of(fill), {ours.data, ours.cols, ours.rows, ours.cols});
    const cv::Mat to_frame = (cv::Mat_<double>(2, 3) << t.a, -t.b, t.x, t.b, t.a, t.y);
    cv::warpAffine(from, theirs, to_frame, from.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::warpAffine(cv::Mat(from.size(), CV_8U, cv::Scalar(255)), known, to_frame, from.size(),
                   cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
    cv::erode(known, known, cv::Mat(), {-1, -1}, 3, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::Mat difference;
    cv::absdiff(ours, theirs, difference);
    double most = 0;
    cv::minMaxLoc(difference, nullptr, &most, nullptr, nullptr, known);
    // 1/16 pixel against 1/32, on gravel whose steps reach 60 levels a pixel.
    EXPECT_LE(most, 6);
    EXPECT_LT(cv::mean(difference, known)[0], 0.5);
  }
}

// goodFeaturesToTrack, calcOpticalFlowPyrLK, estimateAffinePartial2D: reference -> frame.
cv::Mat motion_by_opencv(const cv::Mat& reference, const cv::Mat& frame) {
  std::vector<cv::Point2f> from, to;
  cv::goodFeaturesToTrack(reference, from, 300, 0.01, 8);
  std::vector<uint8_t> found;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(reference, frame, from, to, found, error);
  std::vector<cv::Point2f> a, b;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (found[i] == 0) continue;
    a.push_back(from[i]), b.push_back(to[i]);
  }
  return cv::estimateAffinePartial2D(a, b, cv::noArray(), cv::RANSAC, 1.0);
}

TEST(StabiliserOracle, AgreesWithOpticalFlow) {
  nt::Tank tank({.scene = "shake", .seed = 3, .width = 480, .height = 272});
  nt::Arena measure;
  nt::Stabiliser::create(measure, nt::Stabilise::on, 480, 272);
  const nt::test::Block block(measure.used());
  nt::Arena arena(block.span());
  nt::Stabiliser* stabiliser = nt::Stabiliser::create(arena, nt::Stabilise::on, 480, 272);
  cv::Mat reference;
  for (int n = 0; n < 90; ++n) {
    const cv::Mat frame = copy_of(tank.render_next());
    if (n == 0) reference = frame;
    const nt::Stabilised seen = stabiliser->apply(view_of(frame), {});
    if (n % 15 != 14) continue;
    const cv::Mat theirs = motion_by_opencv(reference, frame);
    ASSERT_FALSE(theirs.empty());
    for (const cv::Point2d p : {cv::Point2d{0, 0}, cv::Point2d{479, 0}, cv::Point2d{240, 136}, cv::Point2d{479, 271}}) {
      const nt::Vec2 ours = seen.frame_from_reference({static_cast<float>(p.x), static_cast<float>(p.y)});
      EXPECT_NEAR(ours.x, theirs.at<double>(0, 0) * p.x + theirs.at<double>(0, 1) * p.y + theirs.at<double>(0, 2), 0.6);
      EXPECT_NEAR(ours.y, theirs.at<double>(1, 0) * p.x + theirs.at<double>(1, 1) * p.y + theirs.at<double>(1, 2), 0.6);
    }
  }
}

}  // namespace
