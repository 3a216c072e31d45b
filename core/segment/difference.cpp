// SPDX-License-Identifier: Apache-2.0
#include "core/segment/difference.h"

#include "core/segment/lanes.h"

namespace nt {
namespace {

uint64_t difference_word(const uint8_t* luma, const uint8_t* background, int threshold, int sign) {
  const ByteLanes d;
  const auto limit = hn::Set(d, static_cast<uint8_t>(threshold));
  uint64_t word = 0;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, luma + i);
    const auto b = hn::LoadU(d, background + i);
    const auto diff = sign > 0 ? hn::SaturatedSub(v, b) : (sign < 0 ? hn::SaturatedSub(b, v) : abs_diff(v, b));
    // diff > limit, as unsigned bytes.
    hn::StoreMaskBits(d, hn::Ne(hn::SaturatedSub(diff, limit), hn::Zero(d)), reinterpret_cast<uint8_t*>(&word) + i / 8);
  }
  return word;
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
  uint8_t tail[64], background_tail[64] = {};
  for (int y = 0; y < luma.height; ++y) {
    const uint8_t* b = background.row(y);
    uint64_t* words = foreground.row(y);
    for_segments(luma.row(y), luma.width, tail, [&](int x, const uint8_t* at) {
      const uint64_t valid = valid_bits(x, luma.width);
      const uint8_t* under = b + x;
      if (at == tail) {  // the background may be a part of a larger plane: read no further than the row
        std::memcpy(background_tail, under, static_cast<std::size_t>(luma.width - x));
        under = background_tail;
      }
      words[x >> 6] = difference_word(at, under, threshold, sign) & valid;
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

}  // namespace nt
