// SPDX-License-Identifier: Apache-2.0
// Views of pixel rows that somebody else owns. x right, y down, pixel centres at integers.
#pragma once
#include <cstddef>
#include <cstdint>

namespace nt {

template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;  // elements from one row to the next
  T* row(int y) const { return data + y * stride; }
  bool empty() const { return width <= 0 || height <= 0; }
};

using LumaView = ImageView<const uint8_t>;

// A half-open box of pixels: x0 <= x < x1, y0 <= y < y1.
struct Box {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

inline int min_int(int a, int b) { return a < b ? a : b; }
inline int max_int(int a, int b) { return a > b ? a : b; }
inline int clamp_int(int v, int lo, int hi) { return v < lo ? lo : (v > hi ? hi : v); }

inline Box grown(const Box& b, int by, int width, int height) {
  return {max_int(b.x0 - by, 0), max_int(b.y0 - by, 0), min_int(b.x1 + by, width), min_int(b.y1 + by, height)};
}

// One bit a pixel, 64 pixels a word; bit x % 64 of word x / 64. Bits at and past `width` are always 0.
struct BitMask {
  uint64_t* words = nullptr;
  int width = 0;
  int height = 0;
  int words_per_row = 0;
  bool empty() const { return width <= 0 || height <= 0; }
  uint64_t* row(int y) const { return words + static_cast<std::ptrdiff_t>(y) * words_per_row; }
  bool at(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && ((row(y)[x >> 6] >> (x & 63)) & 1u) != 0;
  }
  void set(int x, int y) const { row(y)[x >> 6] |= uint64_t{1} << (x & 63); }
  void clear(int x, int y) const { row(y)[x >> 6] &= ~(uint64_t{1} << (x & 63)); }
};

constexpr int words_for(int width) { return (width + 63) / 64; }

}  // namespace nt
