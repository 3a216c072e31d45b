// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/shrink.h"

#include <hwy/highway.h>

namespace nt {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSmallWidth = 160;
constexpr int kMostFactor = 16;  // 16 rows of 255 fit 16 bits

// columns[x] = sum of `rows` pixels from row y down.
void add_rows(LumaView luma, int y, int rows, uint16_t* columns) {
  const hn::CappedTag<uint16_t, 32> d;
  const hn::Rebind<uint8_t, decltype(d)> bytes;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= luma.width; x += lanes) {
    const uint8_t* at = luma.row(y) + x;
    auto sum = hn::PromoteTo(d, hn::LoadU(bytes, at));
    for (int k = 1; k < rows; ++k) sum = hn::Add(sum, hn::PromoteTo(d, hn::LoadU(bytes, at + k * luma.stride)));
    hn::StoreU(sum, d, columns + x);
  }
  for (; x < luma.width; ++x) {
    int sum = 0;
    for (int k = 0; k < rows; ++k) sum += luma.row(y + k)[x];
    columns[x] = static_cast<uint16_t>(sum);
  }
}

}  // namespace

int shrink_factor(int width) {
  int factor = 1;
  while (factor < kMostFactor && width > factor * kSmallWidth) factor *= 2;
  return factor;
}

void shrink(LumaView luma, int factor, std::span<uint16_t> columns, ImageView<uint16_t> small) {
  const int area = factor * factor;
  for (int j = 0; j < small.height; ++j) {
    add_rows(luma, j * factor, factor, columns.data());
    const uint16_t* from = columns.data();
    uint16_t* to = small.row(j);
    for (int i = 0; i < small.width; ++i, from += factor) {
      uint32_t sum = 0;
      for (int k = 0; k < factor; ++k) sum += from[k];
      to[i] = static_cast<uint16_t>(sum * 16 / static_cast<uint32_t>(area));
    }
  }
}

}  // namespace nt
