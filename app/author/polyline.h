// SPDX-License-Identifier: Apache-2.0
// Measures of an open polyline of at least one point. Any frame and unit; O(points) each.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vec2.h"

namespace nt {

float line_length(std::span<const Vec2> line);
// The point `along` from the first one; the ends hold before and after.
Vec2 along_line(std::span<const Vec2> line, float along);
// Unit, towards the last point; of the segment that holds `along`.
Vec2 direction_of_line(std::span<const Vec2> line, float along);

enum class LineEnds : uint8_t { stop, go_on };  // go_on: straight, beyond the first and the last point
struct OnLine {
  Vec2 at;
  float along = 0;  // from the first point; outside 0..length only where the ends go on
};
OnLine nearest_on_line(std::span<const Vec2> line, Vec2 p, LineEnds ends);

// A smooth curve through the points (Catmull-Rom), eight points for each segment.
std::vector<Vec2> rounded_line(std::span<const Vec2> line);
// `count` >= 2 points at even distances.
std::vector<Vec2> evenly(std::span<const Vec2> line, int count);
// Without the tremor of a hand: each inner point goes half way to the middle of its neighbours, `rounds` times.
std::vector<Vec2> calmed(std::span<const Vec2> line, int rounds);

}  // namespace nt
