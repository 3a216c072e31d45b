// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/opencv_stabilise.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace nt::test {

OpenCvStabiliser::OpenCvStabiliser(const cv::Mat& reference) : reference_(reference) { choose_corners(reference); }

void OpenCvStabiliser::choose_corners(const cv::Mat& luma) { cv::goodFeaturesToTrack(luma, corners_, 200, 0.01, 16); }

const cv::Mat& OpenCvStabiliser::step(const cv::Mat& luma) {
  cv::calcOpticalFlowPyrLK(reference_, luma, corners_, seen_, found_, error_);
  std::vector<cv::Point2f> from, to;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (found_[i] == 0) continue;
    from.push_back(corners_[i]), to.push_back(seen_[i]);
  }
  const cv::Mat frame_from_reference = cv::estimateAffinePartial2D(from, to, cv::noArray(), cv::RANSAC, 1.0);
  if (frame_from_reference.empty()) {
    steady_ = luma;
  } else {
    cv::warpAffine(luma, steady_, frame_from_reference, luma.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  }
  if (3 * from.size() < 2 * corners_.size()) choose_corners(reference_);
  return steady_;
}

}  // namespace nt::test
