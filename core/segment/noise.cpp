// SPDX-License-Identifier: Apache-2.0
#include "core/segment/noise.h"

namespace nt {
namespace {

// Median of a histogram of differences, interpolated inside its bin; bin v covers [v - 0.5, v + 0.5), bin 0 [0, 0.5).
float median_of(const std::array<int, 256>& histogram, int total) {
  int below = 0;
  for (int v = 0; v < 256; ++v) {
    const int n = histogram[static_cast<std::size_t>(v)];
    if (2 * (below + n) >= total && n > 0) {
      const float inside = (0.5f * static_cast<float>(total) - static_cast<float>(below)) / static_cast<float>(n);
      return v == 0 ? 0.5f * inside : static_cast<float>(v) - 0.5f + inside;
    }
    below += n;
  }
  return 255.0f;
}

}  // namespace

void NoiseMeter::add(LumaView luma) {
  if (count_ >= kNoiseFrames) return;
  const int nx = min_int(kGrid, luma.width), ny = min_int(kGrid, luma.height);
  std::array<int, 256> histogram{};
  for (int j = 0; j < ny; ++j) {
    const uint8_t* row = luma.row((2 * j + 1) * luma.height / (2 * ny));
    for (int i = 0; i < nx; ++i) {
      const uint8_t now = row[(2 * i + 1) * luma.width / (2 * nx)];
      uint8_t& before = last_[static_cast<std::size_t>(j * kGrid + i)];
      ++histogram[static_cast<std::size_t>(now > before ? now - before : before - now)];
      before = now;
    }
  }
  const int total = nx * ny;
  // A repeated frame says nothing about noise.
  if (has_last_ && histogram[0] < total) {
    sum_ += median_of(histogram, total) / (0.6745f * 1.41421356f);
    ++count_;
  }
  has_last_ = true;
}

float NoiseMeter::sigma() const { return count_ == 0 ? 2.5f : sum_ / static_cast<float>(count_); }

}  // namespace nt
