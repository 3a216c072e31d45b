// SPDX-License-Identifier: Apache-2.0
#include "core/character/fin_region.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr float kBodyShare = 0.9f;

float distance_sq(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 bone = b - a;
  const float len_sq = length_sq(bone);
  const float t = len_sq > 0.0f ? det::clamp(dot(p - a, bone) / len_sq, 0.0f, 1.0f) : 0.0f;
  return length_sq(p - (a + bone * t));
}

}  // namespace

FinRegion::FinRegion(const Character& character, const FinPoints& fin, float reach)
    : character_(character), root_(lerp(fin.top, fin.bottom, 0.5f)), along_(normalised(fin.bottom - fin.top)) {
  side_ = cross(along_, fin.tip - root_) < 0.0f ? -1.0f : 1.0f;
  reach_sq_ = reach * reach * length_sq(fin.tip - root_);
  body_ = kBodyShare * det::min(off_axis(fin.top), off_axis(fin.bottom));
}

float FinRegion::off_axis(Vec2 p) const {
  const ControlPoints& c = character_.rest;
  float nearest = length_sq(p - c.centre);
  Vec2 joint = c.centre;
  for (int i = 0; i <= character_.u_num; ++i) {
    const Vec2 next = i < character_.u_num ? c.up_axis[i] : c.head;
    nearest = det::min(nearest, distance_sq(p, joint, next));
    joint = next;
  }
  joint = c.centre;
  for (int i = 0; i <= character_.l_num; ++i) {
    const Vec2 next = i < character_.l_num ? c.low_axis[i] : c.tail;
    nearest = det::min(nearest, distance_sq(p, joint, next));
    joint = next;
  }
  return det::sqrt(nearest);
}

}  // namespace nt
