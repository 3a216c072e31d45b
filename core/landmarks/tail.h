// SPDX-License-Identifier: Apache-2.0
// A thin tail, which no threshold keeps: axis, picture and background -> the axis, whose rear part follows the tail's line.
//
// A larva's tail of one or two pixels fades into noise long before it ends, and the outline of the mask goes astray with the
// noise. Averaged along its own course it can still be seen: from the middle of the axis all smooth ways are tried that the
// tail can have taken, and of all of them, at every length, the one is kept along which the picture differs most from what
// lies beside it. A way is worth the sum over its steps of (contrast - kFaint of the tail's own), less what its turns cost,
// less what it is longer or shorter than the fish usually is. Dynamic programming: of ways that have come to the same place
// the better one goes on, and at most kBeam of them (core/landmarks/tail.cpp).
// A tail that is broader than the line that is looked for stays as it is.
// Input: `usual_length` of the whole axis, 0 when unknown; pixels of the picture, as the axis. Memory: 20 KB of the stack.
// Cost: some 700 pixels of both pictures, then up to 960 a step of 2 pixels; a larva of 80 pixels has some 30 steps.
// Source: ours; dynamic programming as for minimal paths (Viterbi 1967), on a tree of directions instead of a grid.
#pragma once
#include "core/base/image_view.h"
#include "core/outline/midline.h"

namespace nt {

Axis followed_tail(const Axis& axis, LumaView luma, LumaView ground, float usual_length);

}  // namespace nt
