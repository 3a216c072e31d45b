// SPDX-License-Identifier: Apache-2.0
#include "core/segment/clean.h"

#include <bit>
#include <cstring>

namespace nt {
namespace {

uint64_t last_word_bits(int width) { return (width & 63) == 0 ? ~uint64_t{0} : (uint64_t{1} << (width & 63)) - 1; }

// Word i of a row, where bits outside the picture read as `outside` (all ones or all zeros).
struct Row {
  const uint64_t* words;  // null: a row outside the picture
  int count;
  uint64_t last;     // valid bits of the last word
  uint64_t outside;
  uint64_t at(int i) const {
    if (words == nullptr || i < 0 || i >= count) return outside;
    return i == count - 1 ? (words[i] & last) | (outside & ~last) : words[i];
  }
};

template <bool kErode>
void morph3(const BitMask& from, const BitMask& to) {
  const int n = from.words_per_row;
  const uint64_t last = last_word_bits(from.width);
  const uint64_t outside = kErode ? ~uint64_t{0} : 0;
  const auto join = [](uint64_t a, uint64_t b) { return kErode ? a & b : a | b; };
  for (int y = 0; y < from.height; ++y) {
    const Row above{y > 0 ? from.row(y - 1) : nullptr, n, last, outside};
    const Row here{from.row(y), n, last, outside};
    const Row below{y + 1 < from.height ? from.row(y + 1) : nullptr, n, last, outside};
    const auto column = [&](int i) { return join(join(above.at(i), here.at(i)), below.at(i)); };
    uint64_t before = column(-1), now = column(0);
    uint64_t* out = to.row(y);
    for (int i = 0; i < n; ++i) {
      const uint64_t after = column(i + 1);
      const uint64_t left = (now << 1) | (before >> 63), right = (now >> 1) | (after << 63);
      out[i] = join(join(left, now), right) & (i == n - 1 ? last : ~uint64_t{0});
      before = now, now = after;
    }
  }
}

}  // namespace

void erode3(const BitMask& from, const BitMask& to) { morph3<true>(from, to); }
void dilate3(const BitMask& from, const BitMask& to) { morph3<false>(from, to); }

void open_mask(const BitMask& mask, const BitMask& scratch, int size) {
  // r erosions and r dilations: 2 r passes, an even number, so the result ends where it began.
  const int r = (size - 1) / 2;
  const BitMask* from = &mask;
  const BitMask* to = &scratch;
  for (int i = 0; i < 2 * r; ++i) {
    i < r ? erode3(*from, *to) : dilate3(*from, *to);
    const BitMask* other = from;
    from = to, to = other;
  }
}

int count_bits(const BitMask& mask) {
  int sum = 0;
  for (int i = 0; i < mask.words_per_row * mask.height; ++i) sum += std::popcount(mask.words[i]);
  return sum;
}

void clear_mask(const BitMask& mask) {
  std::memset(mask.words, 0, static_cast<std::size_t>(mask.words_per_row) * static_cast<std::size_t>(mask.height) * 8);
}

}  // namespace nt
