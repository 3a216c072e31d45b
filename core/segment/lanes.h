// SPDX-License-Identifier: Apache-2.0
// Small SIMD helpers that the segment kernels share. Static Highway dispatch: one target per build.
//
// Kernels walk a row in segments of 64 pixels, one mask word each. Highway's lanes divide 64, so results do not depend
// on the lane count.
#pragma once
#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

namespace nt {

namespace hn = hwy::HWY_NAMESPACE;

using ByteLanes = hn::CappedTag<uint8_t, 64>;

// |a - b| for unsigned bytes.
template <class V>
HWY_INLINE V abs_diff(V a, V b) {
  return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
}

// The 64 readable bytes of a row's segment at `x`. The last, partial segment of a row that is not padded is copied to `tail`
// first and filled with the row's last pixel.
inline const uint8_t* segment_at(const uint8_t* row, int x, int width, uint8_t* tail) {
  if (x + 64 <= width) return row + x;
  const int n = width - x;
  std::memcpy(tail, row + x, static_cast<std::size_t>(n));
  std::memset(tail + n, row[width - 1], static_cast<std::size_t>(64 - n));
  return tail;
}

// Calls f(x, pointer) for every 64-pixel segment of a row, where pointer has 64 readable bytes.
template <class F>
HWY_INLINE void for_segments(const uint8_t* row, int width, uint8_t* tail, F&& f) {
  for (int x = 0; x < width; x += 64) f(x, segment_at(row, x, width, tail));
}

// The bits of the word at `x` that lie inside the row.
inline uint64_t valid_bits(int x, int width) {
  return x + 64 <= width ? ~uint64_t{0} : (uint64_t{1} << (width - x)) - 1;
}

// Sets bits i .. i + Lanes of a mask word, clear before, to a comparison's results. Whatever the number of lanes, one too.
template <class M>
HWY_INLINE void store_bits(ByteLanes d, M mask, std::size_t i, uint64_t& word) {
  uint64_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<uint8_t*>(&bits));
  word |= bits << i;
}

// Lanes of 255 where bits i .. i + Lanes of a mask word are set, else 0.
HWY_INLINE hn::Vec<ByteLanes> lanes_of_bits(ByteLanes d, uint64_t word, std::size_t i) {
  const uint64_t bits = word >> i;
  return hn::VecFromMask(d, hn::LoadMaskBits(d, reinterpret_cast<const uint8_t*>(&bits)));
}

}  // namespace nt
