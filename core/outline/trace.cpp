// SPDX-License-Identifier: Apache-2.0
#include "core/outline/trace.h"

#include <bit>

namespace nt {
namespace {

// Clockwise on the screen (y down), starting west.
constexpr int kDx[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
constexpr int kDy[8] = {0, -1, -1, -1, 0, 1, 1, 1};

bool first_pixel(const BitMask& mask, int& x, int& y) {
  for (y = 0; y < mask.height; ++y) {
    for (int i = 0; i < mask.words_per_row; ++i) {
      if (mask.row(y)[i] == 0) continue;
      x = 64 * i + std::countr_zero(mask.row(y)[i]);
      return true;
    }
  }
  return false;
}

}  // namespace

int trace_outline(const BitMask& mask, int origin_x, int origin_y, std::span<Vec2> out) {
  int x0 = 0, y0 = 0;
  if (!first_pixel(mask, x0, y0)) return 0;
  int x = x0, y = y0, count = 0;
  int from = 0;         // direction of the background pixel we came past; the first pixel's west is clear
  int first_move = -2;  // not left yet
  for (;;) {
    int move = -1;
    for (int k = 1; k <= 8; ++k) {
      const int d = (from + k) & 7;
      if (mask.at(x + kDx[d], y + kDy[d])) {
        move = d;
        break;
      }
    }
    if (x == x0 && y == y0) {
      if (move == first_move) return count;  // about to leave the start as we first did: the border is closed
      if (first_move == -2) first_move = move;
    }
    if (count >= static_cast<int>(out.size())) return -1;
    out[static_cast<std::size_t>(count++)] = {static_cast<float>(x + origin_x), static_cast<float>(y + origin_y)};
    if (move < 0) return count;  // a single pixel
    x += kDx[move], y += kDy[move];
    // Seen from the new pixel, the clear one tested just before `move`: even moves turn back by 2 steps, odd by 3.
    from = (move + ((move & 1) != 0 ? 5 : 6)) & 7;
  }
}

}  // namespace nt
