// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/warp.h"

#include <hwy/highway.h>

namespace nt {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kBlock = 8;              // pixels that share one base; both ways of counting agree by it
constexpr double kOne = 4294967296.0;  // 1.0 with 32 fractional bits

// Where a row of `out` lies in the frame: 32 fractional bits, and per pixel 12.
struct Line {
  int64_t u = 0, v = 0;            // of the block's first pixel
  int64_t step_u = 0, step_v = 0;  // a pixel
  int du = 0, dv = 0;              // a pixel inside a block, 12 fractional bits
};

Line line_of(const Similarity& t, int y) {
  const double fy = y;
  Line line;
  line.u = static_cast<int64_t>((t.x - t.b * fy) * kOne);
  line.v = static_cast<int64_t>((t.y + t.a * fy) * kOne);
  line.step_u = static_cast<int64_t>(t.a * kOne);
  line.step_v = static_cast<int64_t>(t.b * kOne);
  line.du = static_cast<int>(line.step_u >> 20);
  line.dv = static_cast<int>(line.step_v >> 20);
  return line;
}

// A block's base: the frame's pixel at or above and left of all its samples, and the first sample's place from there.
struct Base {
  int x = 0, y = 0;
  int fu = 0, fv = 0;  // 12 fractional bits, not negative for any pixel of the block
};

Base base_of(const Line& line) {
  Base base;
  base.x = static_cast<int>(line.u >> 32);
  base.fu = static_cast<int>(line.u >> 20) & 4095;
  const int lowest = line.dv < 0 ? (kBlock - 1) * line.dv : 0;  // 12 bits below v at the block's end
  const int64_t v = line.v >> 20;
  base.y = static_cast<int>((v + lowest) >> 12);
  base.fv = static_cast<int>(v - (static_cast<int64_t>(base.y) << 12));
  return base;
}

uint8_t blend(int tl, int tr, int bl, int br, int fx, int fy) {
  const int top = (tl * 16 + (tr - tl) * fx + 1) >> 1;
  const int bottom = (bl * 16 + (br - bl) * fx + 1) >> 1;
  return static_cast<uint8_t>((top * 16 + (bottom - top) * fy + 64) >> 7);
}

// Pixels x .. x + count of a block; returns how many were seen.
int warp_block_plain(LumaView luma, const Base& base, const Line& line, int count, const uint8_t* fill, uint8_t* out) {
  int seen = 0;
  for (int i = 0; i < count; ++i) {
    const int ru = base.fu + i * line.du, rv = base.fv + i * line.dv;
    const int x = base.x + (ru >> 12), y = base.y + (rv >> 12);
    if (x < 0 || y < 0 || x + 1 >= luma.width || y + 1 >= luma.height) {
      out[i] = fill[i];
      continue;
    }
    const uint8_t* top = luma.row(y) + x;
    const uint8_t* bottom = top + luma.stride;
    out[i] = blend(top[0], top[1], bottom[0], bottom[1], (ru >> 8) & 15, (rv >> 8) & 15);
    ++seen;
  }
  return seen;
}

#if HWY_TARGET == HWY_SCALAR
constexpr bool kHasBlocks = false;
void warp_block(LumaView, const Base&, const Line&, uint8_t*) {}
#else
constexpr bool kHasBlocks = true;

// Eight pixels at once: 16 bytes of each of three rows hold every neighbour, since a row's samples advance by about one
// pixel and stray from it by less than one row.
void warp_block(LumaView luma, const Base& base, const Line& line, uint8_t* out) {
  const hn::FixedTag<uint16_t, 8> d;
  const hn::FixedTag<int16_t, 8> s;
  const hn::FixedTag<uint8_t, 16> bytes;
  const hn::FixedTag<uint8_t, 8> half_bytes;
  const auto lane = hn::Iota(d, 0);
  const auto ru =
      hn::Add(hn::Set(d, static_cast<uint16_t>(base.fu)), hn::Mul(lane, hn::Set(d, static_cast<uint16_t>(line.du))));
  const auto rv =
      hn::Add(hn::Set(d, static_cast<uint16_t>(base.fv)), hn::Mul(lane, hn::Set(d, static_cast<uint16_t>(line.dv))));
  const auto fifteen = hn::Set(d, uint16_t{15});
  const auto fx = hn::BitCast(s, hn::And(hn::ShiftRight<8>(ru), fifteen));
  const auto fy = hn::BitCast(s, hn::And(hn::ShiftRight<8>(rv), fifteen));
  // The upper byte of each index, 128, looks up a zero: bytes become 16-bit lanes.
  const auto left = hn::Or(hn::ShiftRight<12>(ru), hn::Set(d, uint16_t{0x8000}));
  const auto right = hn::Add(left, hn::Set(d, uint16_t{1}));
  const auto one = hn::Set(s, int16_t{1});
  const auto across = [&](int row) {  // a row's samples, in eighths of a grey level
    const auto window = hn::LoadU(bytes, luma.row(base.y + row) + base.x);
    const auto l = hn::BitCast(s, hn::TableLookupBytesOr0(window, hn::BitCast(bytes, left)));
    const auto r = hn::BitCast(s, hn::TableLookupBytesOr0(window, hn::BitCast(bytes, right)));
    const auto sum = hn::Add(hn::ShiftLeft<4>(l), hn::Mul(hn::Sub(r, l), fx));
    return hn::ShiftRight<1>(hn::Add(sum, one));
  };
  auto top = across(0), bottom = across(1);
  const auto lower = hn::Ne(hn::ShiftRight<12>(rv), hn::Zero(d));
  if (!hn::AllFalse(d, lower)) {
    const auto next = across(2);
    const auto below = hn::MaskFromVec(hn::BitCast(s, hn::VecFromMask(d, lower)));
    top = hn::IfThenElse(below, bottom, top);
    bottom = hn::IfThenElse(below, next, bottom);
  }
  const auto sum = hn::Add(hn::ShiftLeft<4>(top), hn::Mul(hn::Sub(bottom, top), fy));
  const auto value = hn::ShiftRight<7>(hn::Add(sum, hn::Set(s, int16_t{64})));
  hn::StoreU(hn::DemoteTo(half_bytes, value), half_bytes, out);
}
#endif

bool inside(LumaView luma, const Base& base) {
  return base.x >= 0 && base.y >= 0 && base.x + 16 <= luma.width && base.y + 3 <= luma.height;
}

template <bool kFast>
float warp(LumaView luma, const Similarity& from_out, LumaView fill, ImageView<uint8_t> out) {
  int64_t seen = 0;
  for (int y = 0; y < out.height; ++y) {
    Line line = line_of(from_out, y);
    for (int x = 0; x < out.width; x += kBlock) {
      const Base base = base_of(line);
      const int count = min_int(kBlock, out.width - x);
      if (kFast && kHasBlocks && count == kBlock && inside(luma, base)) {
        warp_block(luma, base, line, out.row(y) + x);
        seen += kBlock;
      } else {
        seen += warp_block_plain(luma, base, line, count, fill.row(y) + x, out.row(y) + x);
      }
      line.u += kBlock * line.step_u, line.v += kBlock * line.step_v;
    }
  }
  return static_cast<float>(seen) / (static_cast<float>(out.width) * static_cast<float>(out.height));
}

}  // namespace

float warp_luma(LumaView luma, const Similarity& from_out, LumaView fill, ImageView<uint8_t> out) {
  return warp<true>(luma, from_out, fill, out);
}

float warp_luma_plain(LumaView luma, const Similarity& from_out, LumaView fill, ImageView<uint8_t> out) {
  return warp<false>(luma, from_out, fill, out);
}

}  // namespace nt
