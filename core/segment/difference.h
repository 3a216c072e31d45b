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

// One sigma-delta step outside `foreground` and `keep` (null: nothing is kept), and only where luma and background differ
// by at most `limit`.
void follow_background(LumaView luma, const BitMask& foreground, const BitMask* keep, int limit,
                       ImageView<uint8_t> background);

// Up to which difference frame number `frame` may move the background; negative: not at all in this frame. Quick while the
// plane settles, then every 8th frame for noise and slow light, every 64th for anything: a shadow that passes in a second
// must not darken the plane, or its place stands out as a ghost afterwards.
inline int follow_limit(uint32_t frame, int weak_threshold) {
  if ((frame & 63) == 63) return 255;
  return frame < 32 || (frame & 7) == 0 ? weak_threshold : -1;
}

}  // namespace nt
