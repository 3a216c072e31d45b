// SPDX-License-Identifier: Apache-2.0
// A few short lines of text as a picture with a transparent ground, for frame numbers and status lines.
//
// Drawn with OpenCV's vector font, white on a dark rim; redrawn only when the text changes. Cost when it does: about
// 0.1 ms a line.
#pragma once
#include <string>

#include <opencv2/core/mat.hpp>

#include "core/scene/scene.h"

namespace nt {

class Text {
 public:
  // `id` is a texture slot of its own (PictureId).
  explicit Text(uint32_t id) : id_(id) {}
  void set(const std::string& lines);  // separated by '\n'
  void draw(Scene& scene, Vec2 at) const;

 private:
  uint32_t id_;
  uint64_t revision_ = 0;
  std::string lines_;
  cv::Mat rgba_;
};

}  // namespace nt
