// SPDX-License-Identifier: Apache-2.0
// A small binomial blur, [1 2 1] x [1 2 1] / 16: luma in a box -> luma, where the camera is so noisy that a single
// pixel says little. It leaves 0.375 of white noise's standard deviation.
//
// Averages round up, as Highway's AverageRound does; border pixels repeat. Cost: two passes over the box.
#pragma once
#include <cstdint>

#include "core/base/image_view.h"

namespace nt {

// `out` has from's size and may have any stride; the two must not overlap.
void blur_binomial(LumaView from, ImageView<uint8_t> out);

}  // namespace nt
