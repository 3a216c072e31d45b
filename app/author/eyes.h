// SPDX-License-Identifier: Apache-2.0
// Spots of a drawing that look like eyes: small round patches, all of one tone, against a ring of another.
//
// Input: the figure's pixels (8UC4 RGBA) and mask. Output: places in the same pixels with a weight from 0 to 1 (contrast
// times roundness), the best first, at most kMost. A drawing of a tail has none; a spotted fish has many: their
// weights are then shared out, so that they say little.
// Method: connected patches over a ladder of thresholds, both ways, as in MSER. Cost: about 50 ms.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/vec2.h"

namespace nt {

struct EyeSpot {
  Vec2 at;
  double weight = 0;
};

std::vector<EyeSpot> eye_spots(const cv::Mat& rgba, const cv::Mat& mask);

}  // namespace nt
