// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/masks/mask_score.h"

namespace nt {

void MaskScore::add(const cv::Mat& mask, const cv::Mat& truth) {
  constexpr uint8_t kForeground = 255, kUnknown = 170, kOutside = 85;
  CV_Assert(mask.size() == truth.size() && mask.type() == CV_8U && truth.type() == CV_8U);
  for (int y = 0; y < truth.rows; ++y) {
    const uint8_t *ours = mask.ptr<uint8_t>(y), *real = truth.ptr<uint8_t>(y);
    for (int x = 0; x < truth.cols; ++x) {
      if (real[x] == kUnknown || real[x] == kOutside) continue;
      const bool is = real[x] == kForeground, said = ours[x] != 0;
      found += is && said;
      invented += !is && said;
      missed += is && !said;
    }
  }
  ++frames;
}

void MaskScore::add(const MaskScore& other) {
  found += other.found, invented += other.invented, missed += other.missed, frames += other.frames;
}

}  // namespace nt
