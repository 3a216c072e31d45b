// SPDX-License-Identifier: Apache-2.0
// A smooth surface through a picture's ground: luma -> quadratic surface of grey levels, and how rough the ground is about it.
//
// Method: medians of a grid of cells, robust fit (iteratively reweighted least squares, weights 1 / (1 + (r/c)^2) with c
// shrinking, so cells covered by a fish drop out). Roughness is the median deviation over a grid of pixels.
// Cost: about 3 ms at 960x544, once.
#pragma once
#include <array>
#include <cstdint>

#include "core/base/image_view.h"

namespace nt {

struct FieldSurface {
  static constexpr int kTerms = 6;
  float coefficients[kTerms] = {};  // of 1, u, v, u^2, uv, v^2 at u, v in [-1, 1] over the picture
  int width = 0, height = 0;        // of the picture
  // `count` grey levels from pixel x0 of row y on.
  void draw(int x0, int y, int count, uint8_t* out) const;
};

FieldSurface fit_field(LumaView luma);

struct FieldResiduals {
  std::array<int, 256> residuals{};  // histogram of |luma - surface| over the grid
  int total = 0;
  int median_level = 0;  // of the surface
  float sigma = 0;       // of the ground about the surface, grey levels; half a level for the surface's own rounding
};
FieldResiduals measure_field(LumaView luma, const FieldSurface& surface);

}  // namespace nt
