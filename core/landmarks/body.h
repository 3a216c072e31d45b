// SPDX-License-Identifier: Apache-2.0
// The two ends of a fish outline and which of them is the head ([F] sections 4.1, 4.2).
//
// Contour (clockwise on the screen), moments -> contour indices of head and tail.
// Ends as in the paper: the contour point farthest from the barycentre, and the farthest in the opposite half; between the
// two tips of a forked caudal fin the nearest point.
// Differs: the paper calls the farther end the tail and lets last frame's direction correct a swap. Here the order is
// decided by evidence gathered over frames, as log odds: the head half is wider, the fish travels head first, and the order
// of the last frame continues. A single odd frame cannot flip it.
#pragma once
#include <span>

#include "core/base/vec2.h"
#include "core/landmarks/landmarks.h"
#include "core/outline/midline.h"

namespace nt {

struct Ends {
  int head = 0;
  int tail = 0;
};

// The farthest point, and the farthest in the opposite half, in any order.
Ends find_ends(std::span<const Vec2> contour, std::span<const float> arc, Vec2 barycentre);

// If the tail end has two tips, the notch between them; else `tail` itself. `reach` is a share of the perimeter.
int notch_of_tail(std::span<const Vec2> contour, std::span<const float> arc, Vec2 barycentre, int tail);

// Log odds that axis.points.front() is the head, from this frame's shape and travel alone. `smooth` is what medial_axis
// wrote: both sides of the smooth outline, right side first, left side backwards.
float order_evidence(std::span<const Vec2> smooth, const Axis& axis, Vec2 travel);

// Belief that follows from the last frame's, which may rarely be wrong.
float carried_belief(float log_odds);

}  // namespace nt
