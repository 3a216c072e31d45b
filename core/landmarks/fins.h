// SPDX-License-Identifier: Apache-2.0
// Pectoral fin tips and the four fin-body junctions ([F] section 4.4).
//
// Original contour with its places along the axis -> per side: tip, top junction, bottom junction, how well it is seen.
// Tip: the farthest point from the axis on its side, between 15 % and 60 % of the length behind the head, so that the
// caudal fin is never taken. Junction (P = head for the top one, tail for the bottom one; Q = tip): R between P and Q
// with the largest angle PQR, then the contour point between Q and R farthest from the line QR.
// Differs: every body has a farthest point, so a fin counts as seen only when its tip stands out from the body, whose
// half-widths without fins come from outline/midline; a folded fin is reported as not seen.
// Cost: O(contour points).
#pragma once
#include <cstdint>
#include <span>

#include "core/base/vec2.h"
#include "core/outline/midline.h"

namespace nt {

struct Fin {
  bool seen = false;
  float confidence = 0;  // 0..1, grows with how far the tip stands out
  int tip = 0;           // contour indices
  int top = 0;
  int bottom = 0;
};

enum class Side : uint8_t { left, right };

// `body`: half-widths without fins.
Fin find_fin(std::span<const Vec2> contour, std::span<const AlongAxis> along, Stretch right, const StationValues& body,
             float axis_length, Side side);

}  // namespace nt
