// SPDX-License-Identifier: Apache-2.0
#include "core/segment/ghost.h"

namespace nt {
namespace {

constexpr int kReach = 3;       // pixels to either side of a run's end: past the blur of an edge
constexpr int kClearly = 2;     // the background's steps must be this many times the picture's
constexpr int kLeastStep = 12;  // grey levels a run end: below it there is no edge to speak of

int step_across(LumaView image, int x, int y) {
  const uint8_t* row = image.row(y);
  const int a = row[max_int(x - kReach, 0)], b = row[min_int(x + kReach, image.width - 1)];
  return a < b ? b - a : a - b;
}

}  // namespace

bool is_ghost(LumaView luma, LumaView background, std::span<const Run> runs, int label) {
  int picture = 0, memory = 0, ends = 0;
  for (const Run& run : runs) {
    if (run.label != label) continue;
    for (int x : {static_cast<int>(run.x0), static_cast<int>(run.x1)}) {
      picture += step_across(luma, x, run.y);
      memory += step_across(background, x, run.y);
      ++ends;
    }
  }
  return memory > kClearly * picture && memory > kLeastStep * ends;
}

}  // namespace nt
