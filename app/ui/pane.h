// SPDX-License-Identifier: Apache-2.0
// A part of the canvas that shows the camera's world: working pixels -> scene pixels.
#pragma once
#include <cmath>
#include <cstdint>

#include "core/base/vec2.h"

namespace nt {

struct Pane {
  Vec2 corner;                // scene pixels, top left
  float scale = 1;            // scene pixels a working pixel
  int width = 0, height = 0;  // scene pixels

  // Pixel centres lie at integers in the frame, the scene's origin is its corner.
  Vec2 to_scene(Vec2 p) const { return corner + (p + Vec2{0.5f, 0.5f}) * scale; }
  Vec2 to_frame(Vec2 p) const { return (p - corner) * (1.0f / scale) - Vec2{0.5f, 0.5f}; }
  bool contains(Vec2 p) const {
    return p.x >= corner.x && p.y >= corner.y && p.x < corner.x + static_cast<float>(width) &&
           p.y < corner.y + static_cast<float>(height);
  }
};

// A pane for frames of width x height: at least 640 scene pixels wide, sides even as video encoders want them.
inline Pane pane_for(int width, int height) {
  Pane pane;
  pane.scale = width < 640 ? 640.0f / static_cast<float>(width) : 1.0f;
  pane.width = static_cast<int>(std::lround(static_cast<float>(width) * pane.scale)) & ~1;
  pane.height = static_cast<int>(std::lround(static_cast<float>(height) * pane.scale)) & ~1;
  return pane;
}

// The pane to the right of another.
inline Pane beside(Pane left) {
  left.corner.x += static_cast<float>(left.width);
  return left;
}

// Texture slots of the pictures that the app itself shows.
enum PictureId : uint32_t {
  kCameraPicture = 1,
  kBackdropPicture = 2,
  kStripPicture = 3,  // the take editor's confidences, of the whole clip and of what the plot shows
  kBandPicture = 4,
  kKeptPicture = 5,  // of the video kept beside a take
  kFirstTextPicture = 16,
  kFirstNumberPicture = 32,
  kFirstCharacterPicture = 64  // one a character
};

}  // namespace nt
