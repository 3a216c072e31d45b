// SPDX-License-Identifier: Apache-2.0
// app/marker.h by OpenCV's aruco module.
#include "app/marker.h"

#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

extern "C" __attribute__((visibility("default"))) bool neontetra_find_marker(const nt::LumaView& luma,
                                                                             std::array<nt::Vec2, 4>& found) {
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat picture(luma.height, luma.width, CV_8UC1, const_cast<uint8_t*>(luma.data),
                        static_cast<std::size_t>(luma.stride));
  const auto family = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_APRILTAG;  // sub-pixel, and content with a narrow rim
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(picture, family, markers, ids, parameters);
  double largest = 0;
  for (const auto& corners : markers) {
    const double area = cv::contourArea(corners);
    if (corners.size() != 4 || area <= largest) continue;
    largest = area;
    for (std::size_t i = 0; i < 4; ++i) found[i] = {corners[i].x, corners[i].y};
  }
  return largest > 0;
}
