// SPDX-License-Identifier: Apache-2.0
// A picture file -> the figure in it: its pixels and its outline. Off the frame path.
//
// Input: any picture OpenCV reads. Output: RGBA pixels cropped to the figure with a margin, scaled so that the longer side
// of the figure is between kMinSide and kMaxSide pixels, and the closed outer border of the figure in those pixels (x
// right, y down, pixel centres at integers), one point per border pixel.
// With transparency the figure is what is opaque; without, what stands out from the ground (ground.h). Of several figures
// the largest is taken.
// Errors: UserError with one line.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace nt {

struct Figure {
  static constexpr int kMaxSide = 1008;  // with the margin 1,024, a texture that any device takes
  static constexpr int kMinSide =
      512;  // smaller drawings are enlarged, so that outlines and triangles have pixels to go by
  static constexpr int kMargin = 8;

  cv::Mat rgba;  // 8UC4; colours continue into the transparent pixels
  cv::Mat mask;  // 8UC1, 255 = figure
  std::vector<Vec2> outline;
  Vec2 picture_origin;  // where the whole picture's top left corner lies, in the pixels of rgba
  Vec2 picture_size;    // and how large it is there
  bool from_alpha = false;
  bool paper = false;  // photographed or scanned on paper, whose light was evened out
  int figures = 1;     // how many were found
};

Figure load_figure(const std::string& path);

}  // namespace nt
