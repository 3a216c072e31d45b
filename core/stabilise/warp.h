// SPDX-License-Identifier: Apache-2.0
// A frame as the reference camera would have seen it: luma -> luma, bilinear, through a similarity.
//
// out(p) = luma(from_out(p)), with 1/16 pixel and 1/16 weights; where the frame does not reach, the pixel of `fill`.
// Integer arithmetic throughout, so the bytes are the same on every target and for every number of lanes.
// Cost: about 0.35 ms at 960x544 and 128-bit lanes; no memory of its own.
// Differs from OpenCV's warpAffine (1/32 pixel weights): by at most two grey levels where the picture is steep.
#pragma once
#include "core/base/image_view.h"
#include "core/base/similarity.h"

namespace nt {

// The warp is made for a camera in the hand; the caller keeps to these limits (see can_warp).
inline constexpr double kMostScaleChange = 0.2;  // a in 1 +- this
inline constexpr double kMostTurn = 0.12;        // |b|: sine of the angle times the scale
inline bool can_warp(const Similarity& t) {
  return t.a > 1 - kMostScaleChange && t.a < 1 + kMostScaleChange && t.b > -kMostTurn && t.b < kMostTurn;
}

// `out` and `fill` have one size, which may differ from luma's. Returns the share of `out` that was seen.
float warp_luma(LumaView luma, const Similarity& from_out, LumaView fill, ImageView<uint8_t> out);

// The same, pixel by pixel: what the fast version is tested against.
float warp_luma_plain(LumaView luma, const Similarity& from_out, LumaView fill, ImageView<uint8_t> out);

}  // namespace nt
