// SPDX-License-Identifier: Apache-2.0
// A plain picture of a mesh and its markers, for films: parallel projection, depth buffer, one lamp at the camera.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/base/vec3.h"

namespace nt {

class MeshView {
 public:
  // Looks along -z (x right, y up) after `turn`; `centre` and `half_height` of the mesh's unit fill the picture.
  MeshView(int width, int height, Quat turn, float half_height);
  // Places are x, y, z; triangles index them. A marker that is not seen is left out.
  const cv::Mat& draw(std::span<const float> places, const std::vector<uint32_t>& triangles,
                      std::span<const Vec3> markers, Vec3 centre);

 private:
  Vec3 project(Vec3 p, Vec3 centre) const;
  void fill(Vec3 a, Vec3 b, Vec3 c, float light);

  int width_, height_;
  Quat turn_;
  float scale_;
  cv::Mat picture_, depth_;
};

}  // namespace nt
