// SPDX-License-Identifier: Apache-2.0
// Rows of a camera's raw picture -> rows of luma.
//
// `width` pixels; rows do not overlap. `limited`: luma of 16 to 235 is spread to 0 to 255, what lies outside is cut off:
// y' = t + ((42 t + 128) >> 8) with t = max(y - 16, 0), which is round(t 255 / 219) to within one.
// Cost: one pass, Highway; the plain versions give the same bytes (tests).
#pragma once
#include <cstdint>

namespace nt {

void luma_from_yuyv(const uint8_t* yuyv, int width, bool limited, uint8_t* luma);
void luma_from_limited(const uint8_t* limited, int width, uint8_t* luma);
uint8_t spread_luma(uint8_t y);  // the plain version, of one pixel

}  // namespace nt
