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
