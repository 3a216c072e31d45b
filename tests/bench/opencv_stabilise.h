// SPDX-License-Identifier: Apache-2.0
// A handheld camera made steady by plain OpenCV calls: what our stabilising is timed against.
//
// luma frame -> luma in the frame of reference of the first. Corners of the first frame (goodFeaturesToTrack) are found
// again in each frame (calcOpticalFlowPyrLK), a similarity is fitted (estimateAffinePartial2D, RANSAC) and the frame is
// resampled (warpAffine). Corners are chosen anew when a third of them is lost, as a good programmer would.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace nt::test {

class OpenCvStabiliser {
 public:
  explicit OpenCvStabiliser(const cv::Mat& reference);
  const cv::Mat& step(const cv::Mat& luma);

 private:
  void choose_corners(const cv::Mat& luma);

  cv::Mat reference_, steady_;
  std::vector<cv::Point2f> corners_, seen_;
  std::vector<uint8_t> found_;
  std::vector<float> error_;
};

}  // namespace nt::test
