// SPDX-License-Identifier: Apache-2.0
#include "core/segment/smooth.h"

#include "core/segment/lanes.h"

namespace nt {
namespace {

uint8_t average(uint8_t a, uint8_t b) { return static_cast<uint8_t>((a + b + 1) >> 1); }

// out[i] = average(average(before[i], after[i]), here[i]) for n pixels.
void blur_three(const uint8_t* before, const uint8_t* here, const uint8_t* after, int n, uint8_t* out) {
  const ByteLanes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int i = 0;
  for (; i + lanes <= n; i += lanes) {
    const auto sides = hn::AverageRound(hn::LoadU(d, before + i), hn::LoadU(d, after + i));
    hn::StoreU(hn::AverageRound(sides, hn::LoadU(d, here + i)), d, out + i);
  }
  for (; i < n; ++i) out[i] = average(average(before[i], after[i]), here[i]);
}

}  // namespace

void blur_binomial(LumaView from, ImageView<uint8_t> out) {
  const int w = from.width, h = from.height;
  for (int y = 0; y < h; ++y) {  // along the rows
    const uint8_t* row = from.row(y);
    uint8_t* to = out.row(y);
    to[0] = average(average(row[0], row[w > 1 ? 1 : 0]), row[0]);
    if (w > 1) to[w - 1] = average(average(row[w - 2], row[w - 1]), row[w - 1]);
    if (w > 2) blur_three(row, row + 1, row + 2, w - 2, to + 1);
  }
  // Down the columns, in place, in strips so that the row above can be kept as it was.
  constexpr int kStrip = 512;
  uint8_t above[kStrip], here[kStrip];
  for (int x = 0; x < w; x += kStrip) {
    const int n = min_int(kStrip, w - x);
    std::memcpy(above, out.row(0) + x, static_cast<std::size_t>(n));
    for (int y = 0; y < h; ++y) {
      std::memcpy(here, out.row(y) + x, static_cast<std::size_t>(n));
      blur_three(above, here, out.row(min_int(y + 1, h - 1)) + x, n, out.row(y) + x);
      std::memcpy(above, here, static_cast<std::size_t>(n));
    }
  }
}

}  // namespace nt
