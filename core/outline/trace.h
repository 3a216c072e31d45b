// SPDX-License-Identifier: Apache-2.0
// Mask -> ordered outer border of its first component in reading order, clockwise on the screen.
//
// Moore neighbourhood tracing with Jacob's stopping rule; points are pixel centres of border pixels, 8-connected, closed
// (the last is a neighbour of the first). A line one pixel wide is walked out and back.
// Cost: O(border), about 10 ns a point.
#pragma once
#include <span>

#include "core/base/image_view.h"
#include "core/base/vec2.h"

namespace nt {

// Writes to `out` in frame coordinates (mask coordinates + origin). Returns the number of points; -1 when `out` is too
// small; 0 for an empty mask; 1 for a single pixel.
int trace_outline(const BitMask& mask, int origin_x, int origin_y, std::span<Vec2> out);

}  // namespace nt
