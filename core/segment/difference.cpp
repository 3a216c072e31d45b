// SPDX-License-Identifier: Apache-2.0
#include "core/segment/difference.h"

#include "core/segment/lanes.h"

namespace nt {
namespace {

// Bit i: a[i] - b[i] > threshold.
HWY_INLINE uint64_t excess_word(const uint8_t* a, const uint8_t* b, int threshold) {
  const ByteLanes d;
  const auto limit = hn::Set(d, static_cast<uint8_t>(threshold));
  uint64_t word = 0;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto excess = hn::SaturatedSub(hn::SaturatedSub(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), limit);
    store_bits(d, hn::Eq(excess, hn::Zero(d)), i, word);
  }
  return ~word;
}

// Calls f(word index, luma, background, valid bits) for the 64-pixel segments of a row. The background may be a part of a
// larger plane, so of a partial segment no more than the row is read.
template <class F>
HWY_INLINE void for_both(const uint8_t* luma, const uint8_t* background, int width, F&& f) {
  uint8_t tail[64], background_tail[64] = {};
  for_segments(luma, width, tail, [&](int x, const uint8_t* at) {
    const uint8_t* under = background + x;
    if (at == tail) {
      std::memcpy(background_tail, under, static_cast<std::size_t>(width - x));
      under = background_tail;
    }
    f(x >> 6, at, under, valid_bits(x, width));
  });
}

void follow_segment(const uint8_t* luma, uint8_t* background, uint64_t frozen, FollowLimits limits) {
  const ByteLanes d;
  const auto one = hn::Set(d, uint8_t{1});
  const auto above = hn::Set(d, static_cast<uint8_t>(limits.above));
  const auto up_to = hn::Set(d, static_cast<uint8_t>(limits.up_to));
  const auto down_to = hn::Set(d, static_cast<uint8_t>(limits.down_to));
  const auto within = [&](auto difference, auto most) {
    return hn::VecFromMask(d, hn::Eq(hn::Min(difference, most), difference));
  };
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, luma + i);
    const auto b = hn::LoadU(d, background + i);
    const auto brighter = hn::SaturatedSub(v, b), darker = hn::SaturatedSub(b, v);
    auto up = hn::And(hn::Min(hn::SaturatedSub(brighter, above), one), within(brighter, up_to));
    auto down = hn::And(hn::Min(darker, one), within(darker, down_to));
    if (frozen != 0) {
      const auto still = lanes_of_bits(d, frozen, i);
      up = hn::AndNot(still, up), down = hn::AndNot(still, down);
    }
    hn::StoreU(hn::Sub(hn::Add(b, up), down), d, background + i);
  }
}

}  // namespace

void mask_of_difference(LumaView luma, LumaView background, int threshold, int sign, const BitMask& foreground) {
  for (int y = 0; y < luma.height; ++y) {
    uint64_t* words = foreground.row(y);
    for_both(luma.row(y), background.row(y), luma.width,
             [&](int i, const uint8_t* v, const uint8_t* b, uint64_t valid) {
               const uint64_t bright = sign >= 0 ? excess_word(v, b, threshold) : 0;
               const uint64_t dark = sign <= 0 ? excess_word(b, v, threshold) : 0;
               words[i] = (bright | dark) & valid;
             });
  }
}

void masks_of_difference(LumaView luma, LumaView background, int threshold, int offset, const BitMask& bright,
                         const BitMask& dark) {
  const int above = clamp_int(threshold + offset, 0, 255), below = clamp_int(threshold - offset, 0, 255);
  for (int y = 0; y < luma.height; ++y) {
    uint64_t *bright_words = bright.row(y), *dark_words = dark.row(y);
    for_both(luma.row(y), background.row(y), luma.width,
             [&](int i, const uint8_t* v, const uint8_t* b, uint64_t valid) {
               bright_words[i] = excess_word(v, b, above) & valid;
               dark_words[i] = excess_word(b, v, below) & valid;
             });
  }
}

void follow_background(LumaView luma, const BitMask& foreground, const BitMask* keep, FollowLimits limits,
                       ImageView<uint8_t> background) {
  if (limits.up_to == 0 && limits.down_to == 0) return;
  uint8_t tail[64];
  for (int y = 0; y < luma.height; ++y) {
    uint8_t* b = background.row(y);
    const uint64_t* fore = foreground.row(y);
    const uint64_t* kept = keep != nullptr ? keep->row(y) : nullptr;
    for_segments(luma.row(y), luma.width, tail, [&](int x, const uint8_t* at) {
      const uint64_t still = fore[x >> 6] | (kept != nullptr ? kept[x >> 6] : 0);
      follow_segment(at, b + x, still, limits);
    });
  }
}

void copy_runs(LumaView luma, std::span<const Run> runs, int label, ImageView<uint8_t> plane) {
  for (const Run& run : runs) {
    if (run.label != label) continue;
    std::memcpy(plane.row(run.y) + run.x0, luma.row(run.y) + run.x0, static_cast<std::size_t>(run.x1 - run.x0));
  }
}

}  // namespace nt
