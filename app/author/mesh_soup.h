// SPDX-License-Identifier: Apache-2.0
// Triangles as they come out of a file, before they share vertices and a texture. Off the frame path.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/base/vec3.h"

namespace nt {

struct SoupCorner {
  Vec3 position;
  Vec2 texcoord;                 // v down; anything outside [0, 1] repeats
  uint32_t colour = 0xffffffff;  // RGBA, red in the lowest byte
};

struct SoupMaterial {
  cv::Mat texture;  // 8UC4 RGBA; empty: a plain colour
  uint32_t colour = 0xffb0b0b0;
};

struct MeshSoup {
  std::vector<SoupCorner> corners;    // three a triangle
  std::vector<uint32_t> material_of;  // one a triangle
  std::vector<SoupMaterial> materials;
  bool has_colours = false;  // the corners' colours mean something
};

// One texture for all materials: textures side by side, plain colours as patches below. Changes the corners' coordinates to
// it. Where a texture repeats within one triangle, `cut` counts it: it is stretched there.
cv::Mat bake_atlas(MeshSoup& soup, int& cut);

// Vertex colours painted from above and from below (z up) into one picture; changes the corners' coordinates to it.
cv::Mat bake_colours(MeshSoup& soup);

}  // namespace nt
