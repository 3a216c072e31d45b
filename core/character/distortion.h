// SPDX-License-Identifier: Apache-2.0
// How a posed character differs from its drawing: triangles that turned over, and the area of its fins.
//
// Input: the rest pose and triangles of a Character, and vertices posed by Retarget (scene coordinates, y down, or any
// other turned, moved and evenly scaled copy of them). Output: counts, places and ratios; ratios have no unit.
// A triangle turns over when its area's sign, seen from above, differs from the rest pose's. One without area at rest is
// passed over, and so is one of a 3D character that stands so steeply that less than a third of it is seen from above:
// there the sign says nothing.
// A fin's triangles are those whose centre its region holds (fin_region.h), with a tenth more reach than its tip's.
// Memory: 1 byte per triangle, from the arena. Cost: 12 flops per triangle, 10 us for 4,000.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/character/character.h"

namespace nt {

struct Distortion {
  int inverted = 0;  // triangles that turned over
  float least = 1;   // smallest area of a triangle over its area at rest, signed
  Vec2 where;        // centre of the one that turned over the farthest, in the coordinates of the vertices
  // Area of a fin's triangles over their area at rest times scale^2, signed; 1 where there is no such fin.
  float fin_area[kMaxFins] = {1, 1, 1, 1};
};

class DistortionMeter {
 public:
  // Null when the arena is measuring or full. The character must outlive the meter.
  static DistortionMeter* create(Arena& arena, const Character& character);
  // `scale`: length in `vertices` of one character unit. `y_down`: the vertices are in scene coordinates.
  Distortion measure(std::span<const Vec2> vertices, float scale, bool y_down) const;

 private:
  static constexpr uint8_t kPassedOver = 255;
  bool steep(std::size_t triangle) const;
  void mark_fin(int index, const FinPoints& fin);
  Character character_;
  std::span<uint8_t> part_;             // of each triangle: 1 + its fin's index, 0 the body, kPassedOver
  float rest_area_[1 + kMaxFins] = {};  // twice, by part
};

}  // namespace nt
