// SPDX-License-Identifier: Apache-2.0
#include "core/segment/fill.h"

#include <array>

namespace nt {
namespace {

constexpr int kReach = 24;      // known pixels a side: a few pebbles
constexpr int kFarthest = 200;  // pixels to look for them: another unknown run may lie between

struct Side {
  std::array<uint8_t, kReach> values;
  int count = 0;
  int mean() const {
    int sum = count / 2;
    for (int i = 0; i < count; ++i) sum += values[static_cast<std::size_t>(i)];
    return sum / count;
  }
};

Side known_beside(const BitMask& unknown, const uint8_t* row, int x, int y, int step) {
  Side side;
  for (int n = 0; n < kFarthest && side.count < kReach && x >= 0 && x < unknown.width; ++n, x += step)
    if (!unknown.at(x, y)) side.values[static_cast<std::size_t>(side.count++)] = row[x];
  return side;
}

void fill_run(const Side& left, const Side& right, int length, Fill how, Random& random, uint8_t* out) {
  if (left.count + right.count == 0) return;
  const int left_mean = left.count > 0 ? left.mean() : right.mean();
  const int right_mean = right.count > 0 ? right.mean() : left_mean;
  for (int i = 0; i < length; ++i) {
    if (how == Fill::mean) {
      out[i] = static_cast<uint8_t>((left_mean * (length - i) + right_mean * (i + 1) + length / 2) / (length + 1));
      continue;
    }
    const bool from_right = static_cast<int>(random.below(static_cast<uint32_t>(length + 1))) <= i;
    const Side& side = (from_right && right.count > 0) || left.count == 0 ? right : left;
    out[i] = side.values[random.below(static_cast<uint32_t>(side.count))];
  }
}

}  // namespace

void fill_unknown(const BitMask& unknown, Fill how, Random& random, ImageView<uint8_t> plane) {
  for (int y = 0; y < unknown.height; ++y) {
    uint8_t* row = plane.row(y);
    for (int x = 0; x < unknown.width; ++x) {
      if (unknown.row(y)[x >> 6] == 0) x |= 63;  // nothing in this word
      if (!unknown.at(x, y)) continue;
      int end = x + 1;
      while (unknown.at(end, y)) ++end;
      // Both sides are read before the run is written; runs farther on still hold what was there.
      const Side left = known_beside(unknown, row, x - 1, y, -1), right = known_beside(unknown, row, end, y, 1);
      fill_run(left, right, end - x, how, random, row + x);
      x = end;
    }
  }
}

}  // namespace nt
