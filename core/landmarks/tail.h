// SPDX-License-Identifier: Apache-2.0
// The last of a thin tail, which no threshold keeps: axis, picture and background -> the axis, run on along the faint line.
//
// A larva's tail of one or two pixels fades into noise long before it ends. Averaged along its own direction it can still be
// seen: from the end of the axis short segments are tried straight on and to either side, and the best one is taken as long
// as it differs from the ground beside it by a part of what the tail did before. Where the tail ends at once, as most do,
// the axis stays as it is.
// Frame of reference: pixels of the picture. Cost: some 200 pixel reads where the tail ends at once, 150 a step.
#pragma once
#include "core/base/image_view.h"
#include "core/outline/midline.h"

namespace nt {

Axis followed_tail(const Axis& axis, LumaView luma, LumaView ground);

}  // namespace nt
