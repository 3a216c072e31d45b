// SPDX-License-Identifier: Apache-2.0
// A figure -> the control points it is likely to swim with, and how sure each is. Off the frame path.
//
// Input: the figure's mask and outer border (app/author/figure.h), its pixels where there are any (eyes are looked for in
// them), what the user says of the head. Output: landmarks in the same pixels (x right, y down).
// Steps: which two ends are head and tail (ends.h) -> the landmark code of the capture ([F] section 3.2), told so; where its
// midline leaves the figure or ends elsewhere (a curled shark, a lizard), the way inside the figure in its place, with
// what stands out at its sides as fins (appendages.h). The midline never leaves the figure.
// Cost: about 0.3 s. Errors: UserError with one line.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/author/ends.h"
#include "core/character/character.h"
#include "core/landmarks/landmarks.h"

namespace nt {

struct Proposal {
  FishPose pose;             // its fins are those below, first pair
  FinPoints fins[kMaxFins];  // pixels
  bool has_tail_fin = true;
  bool by_capture = false;         // the capture's landmark code found them
  std::vector<float> confidences;  // one per control point, in the order of a character file
};

Proposal propose_landmarks(const std::string& name, const cv::Mat& mask, const cv::Mat& rgba,
                           std::span<const Vec2> outline, const std::optional<ToldHead>& told,
                           const LandmarkSettings& settings);

// One line for each group of points that deserves a look, and for each fin that is not there.
std::vector<std::string> doubts_about(const Proposal& proposal);

}  // namespace nt
