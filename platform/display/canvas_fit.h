// SPDX-License-Identifier: Apache-2.0
// A canvas on a display of another size: as large as fits, its aspect kept, in the middle.
#pragma once
#include <algorithm>
#include <cmath>

namespace nt {

// Where the canvas lies on the display, display pixels.
struct CanvasFit {
  float scale = 1;  // display pixels a scene pixel
  int x = 0, y = 0, width = 0, height = 0;
};

inline CanvasFit fit_canvas(int canvas_width, int canvas_height, int display_width, int display_height) {
  CanvasFit fit;
  if (canvas_width <= 0 || canvas_height <= 0 || display_width <= 0 || display_height <= 0) return fit;
  fit.scale = std::min(static_cast<float>(display_width) / static_cast<float>(canvas_width),
                       static_cast<float>(display_height) / static_cast<float>(canvas_height));
  fit.width = std::max(1, static_cast<int>(std::lround(static_cast<float>(canvas_width) * fit.scale)));
  fit.height = std::max(1, static_cast<int>(std::lround(static_cast<float>(canvas_height) * fit.scale)));
  fit.x = (display_width - fit.width) / 2;
  fit.y = (display_height - fit.height) / 2;
  return fit;
}

}  // namespace nt
