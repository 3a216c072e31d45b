// SPDX-License-Identifier: Apache-2.0
// Temporal noise of the camera: luma frames -> standard deviation in grey levels.
//
// Background noise differs 20-fold between real clips (0.5 to 12.8 grey levels), so thresholds follow it.
// Method: on a fixed grid of at most 64 x 64 pixels, the median of |I_t - I_(t-1)| (a moving fish covers far less than
// half of them), averaged over the first frames; sigma = median / (0.6745 sqrt 2).
// Cost: 4096 pixel reads a frame until kNoiseFrames differences are in, then nothing.
#pragma once
#include <array>
#include <cstdint>

#include "core/base/image_view.h"

namespace nt {

// Radius within which two values of one background pixel match: 20 at an ordinary camera's sigma 2.5, the paper's value.
// Quiet clips can afford less. Noisy ones need little more, as two matches among 20 samples are enough.
inline int match_radius(float sigma) {
  const float r = sigma < 2.5f ? 10.0f + 4.0f * sigma : 20.0f + 0.8f * (sigma - 2.5f);
  return clamp_int(static_cast<int>(r), 10, 48);
}

// Difference from the background's estimate that noise alone hardly reaches.
inline int weak_threshold(float sigma) { return clamp_int(static_cast<int>(2.0f + 3.2f * sigma), 6, 60); }

class NoiseMeter {
 public:
  void restart() { *this = NoiseMeter{}; }
  void add(LumaView luma);
  // Grey levels; 2.5 (an ordinary camera) until two frames have been seen.
  float sigma() const;

 private:
  static constexpr int kGrid = 64;
  static constexpr int kNoiseFrames = 24;
  std::array<uint8_t, kGrid * kGrid> last_{};
  bool has_last_ = false;
  int count_ = 0;
  float sum_ = 0;
};

}  // namespace nt
