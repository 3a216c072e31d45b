// SPDX-License-Identifier: Apache-2.0
// `--background auto`: looks at a clip and picks the background model, with the reason in figures.
//
// Camera (rewound afterwards) -> model and a line for the user. A camera that cannot rewind gets vibe.
// Tests, in this order (METHOD section 1: a fish that holds its place is learned by ViBe as background):
//   backlit: a smooth surface explains most of the picture, one object stands out from it in nearly every frame, and
//            part of that object's first place is never uncovered;
//   still:   a fish covers its first place for long enough to be learned, but the clip's median uncovers it;
//   vibe:    everything else: the first frame is empty, or the fish soon leaves its place.
// Cost: decodes up to kLookFrames frames once; the tests run on 24-48 of them, at most 320 pixels wide.
#pragma once
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "core/segment/background.h"
#include "platform/camera.h"

namespace nt {

inline constexpr int kLookFrames = 600;  // 20 s at 30 frames a second

// 24-48 luma frames spread evenly over the first kLookFrames (fewer in a short clip); the camera is rewound.
// Empty when the camera cannot rewind.
std::vector<cv::Mat> spread_frames(Camera& camera);
std::vector<cv::Mat> spread_pictures(Camera& camera);  // the same of the camera's pictures: grey, or rgb
std::vector<cv::Mat> spread_small(Camera& camera);     // the same frames, float, at most 320 pixels wide

struct BackgroundChoice {
  BackgroundKind kind = BackgroundKind::vibe;
  std::string why;
};
BackgroundChoice choose_background(const std::vector<cv::Mat>& small);  // as spread_small() gives them

}  // namespace nt
