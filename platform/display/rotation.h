// SPDX-License-Identifier: Apache-2.0
// A picture on a screen that hangs turned: sizes and places of the upright picture and of the screen.
//
// Degrees clockwise, 0, 90, 180 or 270: the picture's upper edge comes to lie at the screen's upper, right, lower or left
// edge. Places are pixels, x right, y down.
#pragma once
#include "core/base/vec2.h"
#include "platform/display.h"

namespace nt {

// Of the upright picture on a screen of this size; and the other way round.
inline DisplaySize upright(DisplaySize screen, int rotation_deg) {
  return rotation_deg % 180 == 0 ? screen : DisplaySize{screen.height, screen.width};
}

// Where a place of the screen lies in the upright picture.
inline Vec2 to_upright(Vec2 at, DisplaySize screen, int rotation_deg) {
  const auto width = static_cast<float>(screen.width), height = static_cast<float>(screen.height);
  if (rotation_deg == 90) return {at.y, width - at.x};
  if (rotation_deg == 180) return {width - at.x, height - at.y};
  if (rotation_deg == 270) return {height - at.y, at.x};
  return at;
}

}  // namespace nt
