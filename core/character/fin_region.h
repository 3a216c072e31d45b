// SPDX-License-Identifier: Apache-2.0
// Which part of a drawing is a fin: what moves with it, and what must keep its area.
//
// Rest pose of a character and one of its fins -> whether a point belongs to that fin: it lies beyond the line through the two
// junctions, on the tip's side; no farther from the junctions' middle than the tip, times `reach`; and farther from the
// body's axis than nine tenths of the nearer junction, so that the body beside the fin is none of it. Character units.
// Cost: some 400 flops a point.
#pragma once
#include "core/character/character.h"

namespace nt {

class FinRegion {
 public:
  FinRegion(const Character& character, const FinPoints& fin, float reach);
  bool holds(Vec2 p) const { return beyond(p) > 0.0f && length_sq(p - root_) <= reach_sq_ && off_axis(p) > body_; }
  // How far p lies beyond the line through the junctions.
  float beyond(Vec2 p) const { return side_ * cross(along_, p - root_); }

 private:
  float off_axis(Vec2 p) const;
  const Character& character_;
  Vec2 root_, along_;  // middle of the junctions, unit from the upper to the lower one
  float side_ = 1, reach_sq_ = 0, body_ = 0;
};

}  // namespace nt
