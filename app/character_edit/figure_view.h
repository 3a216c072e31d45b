// SPDX-License-Identifier: Apache-2.0
// Where the figure lies on the screen: figure pixels <-> scene pixels, in a rectangle, its aspect kept; a flipped figure is
// shown flipped.
#pragma once
#include <algorithm>

#include "core/base/vec2.h"

namespace nt {

struct Area {
  Vec2 corner, size;
  bool contains(Vec2 p) const {
    return p.x >= corner.x && p.y >= corner.y && p.x < corner.x + size.x && p.y < corner.y + size.y;
  }
  Vec2 centre() const { return corner + size * 0.5f; }
};

struct FigureView {
  float scale = 1;  // scene pixels a figure pixel
  Vec2 from, to;    // the figure's middle, and where it is shown
  bool flip = false;

  Vec2 to_scene(Vec2 p) const {
    const Vec2 d = (p - from) * scale;
    return {to.x + (flip ? -d.x : d.x), to.y + d.y};
  }
  Vec2 to_figure(Vec2 p) const {
    const Vec2 d = (p - to) * (1 / scale);
    return {from.x + (flip ? -d.x : d.x), from.y + d.y};
  }
};

// `room` scene pixels stay free at each side.
inline FigureView fit_figure(const Area& figure, const Area& area, float room, bool flip) {
  const float width = std::max(area.size.x - 2 * room, 1.0f), height = std::max(area.size.y - 2 * room, 1.0f);
  const float scale = std::min(width / std::max(figure.size.x, 1.0f), height / std::max(figure.size.y, 1.0f));
  return {scale, figure.centre(), area.centre(), flip};
}

}  // namespace nt
