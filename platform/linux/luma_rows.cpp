// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/luma_rows.h"

#include <hwy/highway.h>

#include <algorithm>

namespace nt {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
using Bytes = hn::Full128<uint8_t>;
using Vec = hn::Vec<Bytes>;

HWY_INLINE Vec spread(Vec y) {
  const Bytes d;
  const hn::Full128<uint16_t> wide;
  const hn::Half<Bytes> half;
  const Vec t = hn::SaturatedSub(y, hn::Set(d, 16));
  const auto more = [&](auto part) {
    const auto product = hn::Mul(hn::PromoteTo(wide, part), hn::Set(wide, 42));
    return hn::DemoteTo(half,
                        hn::BitCast(hn::Full128<int16_t>(), hn::ShiftRight<8>(hn::Add(product, hn::Set(wide, 128)))));
  };
  return hn::SaturatedAdd(t, hn::Combine(d, more(hn::UpperHalf(half, t)), more(hn::LowerHalf(half, t))));
}
#endif

}  // namespace

uint8_t spread_luma(uint8_t y) {
  const int t = std::max(y - 16, 0);
  return static_cast<uint8_t>(std::min(t + ((42 * t + 128) >> 8), 255));
}

void luma_from_yuyv(const uint8_t* yuyv, int width, bool limited, uint8_t* luma) {
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (; x + lanes <= width; x += lanes) {
    Vec y, colour;
    hn::LoadInterleaved2(d, yuyv + 2 * x, y, colour);
    hn::StoreU(limited ? spread(y) : y, d, luma + x);
  }
#endif
  for (; x < width; ++x) luma[x] = limited ? spread_luma(yuyv[2 * x]) : yuyv[2 * x];
}

void luma_from_limited(const uint8_t* limited, int width, uint8_t* luma) {
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (; x + lanes <= width; x += lanes) hn::StoreU(spread(hn::LoadU(d, limited + x)), d, luma + x);
#endif
  for (; x < width; ++x) luma[x] = spread_luma(limited[x]);
}

}  // namespace nt
