// SPDX-License-Identifier: Apache-2.0
// The parts of a figure that stand out at the sides of its body: fins, arms, claws, leaves.
//
// Mask, midline (kStations points, head to tail) and the body's half width along it -> up to two pairs of parts, each with
// its tip and the two places where it joins the body. Frame: the mask's pixels.
// Differs from core/landmarks/fins.h, which looks for the pectoral fin of a fish seen from above between 15 % and 60 % of
// the length: a drawing's claw may reach ahead of its head, so a part is what remains of the mask outside the body's tube,
// and it counts by where it is rooted.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <span>

#include "core/base/vec2.h"
#include "core/character/character.h"
#include "core/outline/midline.h"

namespace nt {

struct Appendage {
  FinPoints points;  // pixels
  float confidence = 0;
  double root = 0;  // along the midline, 0 head to 1 tail
  double area = 0;  // pixels
};

using Appendages = std::array<Appendage, kMaxFins>;  // by FinIndex

Appendages find_appendages(const cv::Mat& mask, std::span<const Vec2> outline, const Axis& axis,
                           const StationValues& body);

}  // namespace nt
