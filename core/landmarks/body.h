// SPDX-License-Identifier: Apache-2.0
// The two ends of a fish outline and which of them is the head ([F] sections 4.1, 4.2).
//
// Contour (clockwise on the screen), moments -> contour indices of head and tail.
// Ends as in the paper: the contour point farthest from the barycentre, and the farthest in the opposite half; between the
// two tips of a forked caudal fin the nearest point.
// Differs: the paper calls the farther end the tail and lets last frame's direction correct a swap. Here the order is
// decided by evidence gathered over frames, as log odds: the head half is wider and more opaque, the fish travels head first,
// and the order of the last frame continues. A single odd frame cannot flip it.
#pragma once
#include <span>

#include "core/base/image_view.h"
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

// Ours: for a fish bent so far that its ends are no farther from the barycentre than its flank. The two sharpest convex
// turns of the outline that halve it: both flanks of a fish are about equally long. False when there are no such two.
bool find_tips(std::span<const Vec2> contour, std::span<const float> arc, Ends& tips);

// If the tail end has two tips, the notch between them; else `tail` itself. `from`: a point of the body to measure from.
int notch_of_tail(std::span<const Vec2> contour, std::span<const float> arc, Vec2 from, int tail);

// Log odds that axis.points.front() is the head, from this frame's shape and travel alone. `smooth` is what medial_axis
// wrote: both sides of the smooth outline, right side first, left side backwards.
float order_evidence(std::span<const Vec2> smooth, const Axis& axis, Vec2 travel);

// The same from how much the two halves of the axis differ from the ground: a tail fin is half-transparent.
float contrast_evidence(const Axis& axis, LumaView luma, LumaView ground);

// Log odds that the axis runs the same way as the axis of the frame before, from how far its points have moved.
float continuity(const Axis& axis, std::span<const Vec2> last);

// Log odds that both a and b hold or neither: of `the last head was the head` and `this end continues it`.
float agreed(float a, float b);

}  // namespace nt
