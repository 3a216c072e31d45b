// SPDX-License-Identifier: Apache-2.0
// Character units <-> figure pixels (core/character/character.h, FigureFrame).
#pragma once
#include "core/character/character.h"

namespace nt {

// Where the character's x leads in the figure.
inline Vec2 x_axis(const FigureFrame& f) { return right_of(f.dir) * (f.mirror ? -1.0f : 1.0f); }
inline Vec2 to_figure(const FigureFrame& f, Vec2 p) { return f.centre + x_axis(f) * p.x + f.dir * p.y; }
inline Vec2 to_character(const FigureFrame& f, Vec2 p) {
  return {dot(p - f.centre, x_axis(f)), dot(p - f.centre, f.dir)};
}

}  // namespace nt
