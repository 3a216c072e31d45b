// SPDX-License-Identifier: Apache-2.0
// Row kernels over a background plane: luma and background -> mask, and the sigma-delta update of that plane.
//
// The sigma-delta update (Manzanera and Richefeu 2007, first order) moves each background pixel by one grey level a frame
// towards what is seen: a running median that follows slow light. follow_background wants the plane's rows padded to 64 bytes.
// Cost: one pass, about 5 operations per 16 pixels each.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/segment/blobs.h"

namespace nt {

// Foreground where sign * (luma - background) > threshold; sign +1 bright, -1 dark, 0 either.
void mask_of_difference(LumaView luma, LumaView background, int threshold, int sign, const BitMask& foreground);

// Both signs in one pass: bright where luma - background > threshold + offset, dark where background - luma > threshold -
// offset. `offset` is what the light has gained since the background was learned.
void masks_of_difference(LumaView luma, LumaView background, int threshold, int offset, const BitMask& bright,
                         const BitMask& dark);

// Which differences move the background by one level in a frame: those in (above, up_to] upwards, those up to `down_to`
// downwards. All 0: none.
struct FollowLimits {
  int above = 0, up_to = 0, down_to = 0;
};

// Quick while the plane settles, then noise and slow light every 16th frame. A greater difference counts every 8th frame
// upwards and hardly ever downwards: the fish's shadow must not darken the plane, and where it did, the ghost it leaves
// when the fish moves on must go.
inline FollowLimits follow_limits(uint32_t frame, int weak_threshold) {
  if (frame < 32 || (frame & 15) == 0) return {0, weak_threshold, weak_threshold};
  if ((frame & 127) == 127) return {0, 255, 255};
  if ((frame & 7) == 4) return {weak_threshold, 255, 0};
  return {};
}

// One sigma-delta step outside `foreground` and `keep` (null: nothing is kept).
void follow_background(LumaView luma, const BitMask& foreground, const BitMask* keep, FollowLimits limits,
                       ImageView<uint8_t> background);

// Copies the luma of one blob's runs into a plane.
void copy_runs(LumaView luma, std::span<const Run> runs, int label, ImageView<uint8_t> plane);

}  // namespace nt
