// SPDX-License-Identifier: Apache-2.0
#include "core/segment/clean.h"

#include <bit>
#include <cstring>

namespace nt {
namespace {

uint64_t last_word_bits(int width) { return (width & 63) == 0 ? ~uint64_t{0} : (uint64_t{1} << (width & 63)) - 1; }

bool all_zero(const uint64_t* words, int n) {
  uint64_t any = 0;
  for (int i = 0; i < n; ++i) any |= words[i];
  return any == 0;
}

// A missing row above or below is replaced by the row itself, which changes neither an AND nor an OR with it.
template <bool kErode>
void morph(const BitMask& from, const BitMask& to, int step) {
  const int n = from.words_per_row;
  const uint64_t last = last_word_bits(from.width);
  const uint64_t outside = kErode ? ~uint64_t{0} : 0;
  const auto join = [](uint64_t a, uint64_t b) { return kErode ? a & b : a | b; };
  for (int y = 0; y < from.height; ++y) {
    const uint64_t* here = from.row(y);
    const uint64_t* above = y >= step ? from.row(y - step) : here;
    const uint64_t* below = y + step < from.height ? from.row(y + step) : here;
    uint64_t* out = to.row(y);
    if (all_zero(here, n) && (kErode || (all_zero(above, n) && all_zero(below, n)))) {
      std::memset(out, 0, static_cast<std::size_t>(n) * 8);
      continue;
    }
    const auto column = [&](int i) {
      const uint64_t word = join(join(above[i], here[i]), below[i]);
      return i == n - 1 ? (word & last) | (outside & ~last) : word;
    };
    uint64_t before = outside, now = column(0);
    for (int i = 0; i < n; ++i) {
      const uint64_t after = i + 1 < n ? column(i + 1) : outside;
      out[i] = join(join((now << step) | (before >> (64 - step)), now), (now >> step) | (after << (64 - step)));
      before = now, now = after;
    }
    out[n - 1] &= last;
  }
}

}  // namespace

void erode3(const BitMask& from, const BitMask& to) { morph<true>(from, to, 1); }
void dilate3(const BitMask& from, const BitMask& to) { morph<false>(from, to, 1); }
void spread(const BitMask& from, const BitMask& to, int step) { morph<false>(from, to, step); }

void open_mask(const BitMask& from, const BitMask& scratch, const BitMask& to, int size) {
  const int r = (size - 1) / 2;
  if (r == 0) {
    std::memcpy(to.words, from.words,
                static_cast<std::size_t>(from.words_per_row) * static_cast<std::size_t>(from.height) * 8);
    return;
  }
  // r erosions and r dilations, to and fro between scratch and `to`: an even number, so the last ends in `to`.
  const BitMask* source = &from;
  for (int i = 0; i < 2 * r; ++i) {
    const BitMask* target = i % 2 == 0 ? &scratch : &to;
    i < r ? erode3(*source, *target) : dilate3(*source, *target);
    source = target;
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
