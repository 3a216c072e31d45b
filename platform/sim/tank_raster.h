// SPDX-License-Identifier: Apache-2.0
// Polygon -> exact area coverage of every pixel, anti-aliased.
//
// Input: closed polygons in pixels (pixel centres at integers). Output: coverage in [0, 1] over a box.
// Every edge adds its signed area to the pixels it crosses; a running sum along the row fills the inside. Overlaps of
// one winding count once. Cost: O(edge pixels + box pixels). Source: the accumulation buffer of font-rs (R. Levien).
#pragma once
#include <span>
#include <vector>

#include "core/base/image_view.h"
#include "core/base/vec2.h"

namespace nt::tank {

class Coverage {
 public:
  // Empties the buffer and sets its box, in pixels of the frame divided by `step` (1 or 2: a half-size raster).
  void start(const Box& box, float step = 1.0f);
  void add(std::span<const Vec2> polygon, Vec2 shift = {});
  void finish();          // after the last polygon: areas become coverage
  void blur(int radius);  // three box blurs, close to a gaussian of sd sqrt(radius (radius + 1))

  const Box& box() const { return box_; }
  const float* row(int y) const { return cells_.data() + static_cast<std::size_t>(y - box_.y0) * stride_; }
  float at(int x, int y) const {
    return x < box_.x0 || y < box_.y0 || x >= box_.x1 || y >= box_.y1 ? 0.0f : row(y)[x - box_.x0];
  }

 private:
  void add_edge(Vec2 a, Vec2 b);
  void add_edge_row(float* cells, float dy, float sign, float x0, float x1);
  void blur_rows(int radius);
  void blur_columns(int radius);
  Box box_;
  float step_ = 1.0f;
  std::size_t stride_ = 0;
  std::vector<float> cells_, sums_, copy_;
};

// The smallest box of whole pixels round the points, grown by `margin`.
Box box_of(std::span<const Vec2> points, int margin);

}  // namespace nt::tank
