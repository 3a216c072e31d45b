// SPDX-License-Identifier: Apache-2.0
// A similarity of the plane: shift, rotation and scale. p -> m p + shift, m = (a, -b; b, a); pixels, double.
#pragma once
#include "core/base/vec2.h"

namespace nt {

struct Similarity {
  double a = 1, b = 0;  // scale times cos and sin of the angle
  double x = 0, y = 0;  // shift, pixels

  Vec2 operator()(Vec2 p) const {
    const double px = p.x, py = p.y;
    return {static_cast<float>(a * px - b * py + x), static_cast<float>(b * px + a * py + y)};
  }
  // A difference of two points.
  Vec2 turned(Vec2 v) const {
    const double vx = v.x, vy = v.y;
    return {static_cast<float>(a * vx - b * vy), static_cast<float>(b * vx + a * vy)};
  }
  double scale_sq() const { return a * a + b * b; }
  float scale() const { return static_cast<float>(__builtin_sqrt(scale_sq())); }
  Similarity inverse() const {
    const double per = 1.0 / scale_sq();
    Similarity back{a * per, -b * per, 0, 0};
    back.x = -(back.a * x - back.b * y);
    back.y = -(back.b * x + back.a * y);
    return back;
  }
};

// First `inner`, then `outer`.
inline Similarity after(const Similarity& outer, const Similarity& inner) {
  return {outer.a * inner.a - outer.b * inner.b, outer.b * inner.a + outer.a * inner.b,
          outer.a * inner.x - outer.b * inner.y + outer.x, outer.b * inner.x + outer.a * inner.y + outer.y};
}

}  // namespace nt
