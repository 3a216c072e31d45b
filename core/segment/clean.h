// SPDX-License-Identifier: Apache-2.0
// Morphology on bit-packed masks ([F] section 4: opening against salt and pepper noise).
//
// mask -> mask, 64 pixels a word operation. The square element has side 2 r + 1. As in OpenCV's default border, erosion
// takes pixels outside the picture as set and dilation as clear. Cost: about 10 word operations per 64 pixels and unit
// of r; 0.01 ms at 960x544 for r = 1.
#pragma once
#include "core/base/image_view.h"

namespace nt {

// One step of a 3 x 3 erosion / dilation; `to` must not overlap `from`.
void erode3(const BitMask& from, const BitMask& to);
void dilate3(const BitMask& from, const BitMask& to);
// Each pixel spreads to the nine places 0 or +-step (1..63) away in x and y: steps 1, 2, 4 one after the other make a
// dilation by a square of side 15.
void spread(const BitMask& from, const BitMask& to, int step);

// Opening of `from` into `to` by a square of side `size` (odd; 1 copies); all three have one size, none overlap.
void open_mask(const BitMask& from, const BitMask& scratch, const BitMask& to, int size);

int count_bits(const BitMask& mask);
void clear_mask(const BitMask& mask);

}  // namespace nt
