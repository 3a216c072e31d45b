// SPDX-License-Identifier: Apache-2.0
// The midline of a filmed fish by a slow method that shares nothing with core: the judge of capture on real video.
//
// One grey frame, its ground -> mask, midline from one end of the fish to the other; which end is the head is not decided
// here but written down by a person (real_clips.h).
// Method: difference from the ground, two-level threshold (a pixel over `weak` counts where it hangs together with one over
// `strong`), OpenCV's distance transform, the longest geodesic path through the mask (two sweeps of Dijkstra's algorithm),
// then the path between the same ends that keeps to the middle (a step costs its length over the squared distance from the
// rim). Its ends are cut back by the fish's own half-width there and run straight on to the rim.
// Frame of reference: pixels of the source video. Cost: some 0.1 s a frame; nothing is bounded.
#pragma once
#include <vector>

#include <opencv2/core.hpp>

namespace nt::test {

struct ReferenceSettings {
  bool bright = false;  // the fish is brighter than the ground
  double ground = -1;   // quantile over the clip of every pixel (0..1); -1: the median of the frame, an even field
  int strong = 80, weak = 40;  // grey levels
  int median_filter = 0;       // side of the window against specks; 0: none
  double blur = 0;             // sigma of a Gaussian against noise, pixels; 0: none
  int reach = 180;             // pixels from the strongest spot within which `along` looks for the fish
  double along = 0;            // sigma along lines, against noise around a tail of two pixels; 0: none
  double fork = 0;  // the caudal fin's share of the length, where it is forked: the midline runs between its lobes
};

struct ReferencePose {
  bool found = false;
  std::vector<cv::Point2d> midline;  // from end to end, evenly spaced
  double length = 0;
  cv::Mat mask;
};

// Per pixel quantile over the clip; for ReferenceSettings::ground >= 0.
cv::Mat clip_quantile(const std::vector<cv::Mat>& frames, double quantile);

ReferencePose reference_midline(const cv::Mat& frame, const cv::Mat& ground, const ReferenceSettings& settings);

}  // namespace nt::test
