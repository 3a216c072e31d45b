// SPDX-License-Identifier: Apache-2.0
// Row kernels over a background plane: luma and background -> mask, and the sigma-delta update of that plane.
//
// The sigma-delta update (Manzanera and Richefeu 2007, first order) moves each background pixel by one grey level a frame
// towards what is seen: a running median that follows slow light. follow_background wants the plane's rows padded to 64 bytes.
// Cost: one pass, about 5 operations per 16 pixels each.
#pragma once
#include <cstdint>

#include "core/base/image_view.h"

namespace nt {

// Foreground where sign * (luma - background) > threshold; sign +1 bright, -1 dark, 0 either.
void mask_of_difference(LumaView luma, LumaView background, int threshold, int sign, const BitMask& foreground);

// One sigma-delta step outside `foreground` and `keep` (null: nothing is kept).
void follow_background(LumaView luma, const BitMask& foreground, const BitMask* keep, ImageView<uint8_t> background);

}  // namespace nt
