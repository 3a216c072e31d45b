// SPDX-License-Identifier: Apache-2.0
// A picture of what was found in a figure: its triangles and control points. Off the frame path.
//
// Character -> RGB pixels of the figure's own size: a drawing with its triangles; a solid seen from above, lit
// from the upper left. Head red, tail blue, midline cyan, fin tips green, their roots yellow, centre white.
#pragma once
#include <opencv2/core.hpp>

#include "core/character/character.h"

namespace nt {

cv::Mat draw_preview(const Character& character);

}  // namespace nt
