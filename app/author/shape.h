// SPDX-License-Identifier: Apache-2.0
// What a figure's shape alone says: how deep it is, where it ends, how one gets from one end to another inside it, and
// about which line it is its own mirror image. Off the frame path.
//
// Input: a mask (8UC1, 255 = figure, one piece). Everything below is in the mask's pixels, x right, y down; inside, the work
// is done on a grid of at most kGrid cells a side. Cost: about 20 ms, and as much for each tip of which paths are asked.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/vec2.h"

namespace nt {

struct Path {
  std::vector<Vec2> points;  // from one end to the other, inside the figure
  double length = 0;
  double weight = 0;  // length in which thin stretches (antennae, fin tips) count less
};

struct Mirror {
  double likeness = 0;  // intersection over union of the figure and its mirror image, 0 to 1
  Vec2 point, direction;
};

class Shape {
 public:
  static constexpr int kGrid = 256;

  explicit Shape(const cv::Mat& mask);

  double depth() const { return deepest_ / scale_; }  // of the deepest point: the largest disc's radius
  Vec2 deepest_point() const { return to_picture(deepest_at_); }
  // Ends of the figure's parts, at most `most`, the farthest first: where the way from the deepest point, or from the end
  // that is farthest from it, is longest among the neighbours.
  std::vector<Vec2> tips(std::size_t most) const;
  // The paths from `from` to each of `to` that keep to the middle.
  std::vector<Path> paths(Vec2 from, const std::vector<Vec2>& to) const;
  Mirror mirror() const;
  // Where a line leaves the figure last, against `direction` and along it; empty when it misses.
  std::vector<Vec2> crossings(Vec2 point, Vec2 direction) const;

 private:
  struct Walk {
    cv::Mat cost;    // 32F, of the cheapest way; infinite outside
    cv::Mat before;  // 32S, the cell that the way comes from
  };
  struct Tip {
    cv::Point at;
    float way;
  };
  void collect_tips(const std::vector<cv::Point>& border, cv::Point from, std::vector<Tip>& out) const;
  Walk walk(cv::Point from, bool keep_to_middle) const;
  cv::Point nearest_cell(Vec2 p) const;
  Vec2 to_picture(cv::Point cell) const;

  double scale_ = 1;  // cells per pixel
  cv::Mat cells_;     // 8U
  cv::Mat depth_;     // 32F, distance to the ground in cells
  double deepest_ = 0;
  cv::Point deepest_at_;
};

}  // namespace nt
