// SPDX-License-Identifier: Apache-2.0
// The capture of [F] section 4 made of plain OpenCV and std calls: what our stages are timed against.
//
// luma frame -> FishPose (landmarks as in core/landmarks/fish_pose.h, pixels) and the time of each stage.
// It is the chain that a good programmer writes first: each paper step is the library call that does it
// (BackgroundSubtractorMOG2 or KNN, morphologyEx, connectedComponentsWithStats, threshold with Otsu, findContours, PCA),
// and the steps that no library has are straight loops over std::vector. Buffers that OpenCV lets a caller keep are
// kept. It selects the largest component and does not track: it is faster for it, and less sure.
#pragma once
#include <opencv2/core.hpp>
#include <opencv2/video/background_segm.hpp>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/landmarks/fish_pose.h"

namespace nt::test {

enum class OpenCvModel { mog2, knn };

class OpenCvChain {
 public:
  explicit OpenCvChain(OpenCvModel model);
  // False when there is no fish in the frame.
  bool step(const cv::Mat& luma, NowNs now, StageTimes& times);
  const FishPose& pose() const { return pose_; }
  const std::vector<float>& angles() const { return angles_; }  // Eq 14, radians

 private:
  bool largest_component(cv::Rect& box, int& label) const;
  void remove_shadow(const cv::Mat& luma, const cv::Rect& box, int label);
  bool find_contour(const cv::Rect& box);
  void find_landmarks(const cv::Rect& box);
  void principal_axis(const cv::Rect& box);
  void find_ends();
  void smooth_contour();
  void find_axis();
  void find_fins();
  void find_motion();

  cv::Ptr<cv::BackgroundSubtractor> background_;
  cv::Mat foreground_, cleaned_, labels_, stats_, centroids_, fish_, otsu_, element_;
  std::vector<std::vector<cv::Point>> contours_;
  std::vector<cv::Point2f> contour_, smooth_, axis_;
  std::vector<cv::Point> pixels_;
  std::size_t head_ = 0, tail_ = 0;
  cv::Point2f barycentre_;
  FishPose pose_;
  std::vector<float> angles_;
};

}  // namespace nt::test
