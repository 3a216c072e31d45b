// SPDX-License-Identifier: Apache-2.0
// Random masks for the oracle tests, as OpenCV and as core see them.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/image_view.h"

namespace nt::test {

// A BitMask that owns its words.
class OwnedMask {
 public:
  OwnedMask(int width, int height)
      : words_(static_cast<std::size_t>(words_for(width)) * static_cast<std::size_t>(height)),
        mask_{words_.data(), width, height, words_for(width)} {}
  explicit OwnedMask(const cv::Mat& pixels) : OwnedMask(pixels.cols, pixels.rows) {
    for (int y = 0; y < pixels.rows; ++y) {
      for (int x = 0; x < pixels.cols; ++x) {
        if (pixels.at<uint8_t>(y, x) != 0) mask_.set(x, y);
      }
    }
  }
  const BitMask& view() const { return mask_; }
  cv::Mat pixels() const {
    cv::Mat out(mask_.height, mask_.width, CV_8U);
    for (int y = 0; y < mask_.height; ++y) {
      for (int x = 0; x < mask_.width; ++x) out.at<uint8_t>(y, x) = mask_.at(x, y) ? 255 : 0;
    }
    return out;
  }
  bool bits_past_the_width_are_clear() const {
    if (mask_.width % 64 == 0) return true;
    for (int y = 0; y < mask_.height; ++y) {
      if (mask_.row(y)[mask_.words_per_row - 1] >> (mask_.width % 64) != 0) return false;
    }
    return true;
  }

 private:
  std::vector<uint64_t> words_;
  BitMask mask_;
};

// Widths around the word of 64 pixels, heights down to one row.
inline const std::vector<cv::Size>& mask_sizes() {
  static const std::vector<cv::Size> sizes{{1, 1},   {7, 1},    {1, 9},    {63, 20},  {64, 20},
                                           {65, 20}, {128, 33}, {130, 40}, {320, 180}};
  return sizes;
}

// Salt and pepper: `share` of the pixels set.
inline cv::Mat noise_mask(cv::Size size, double share, cv::RNG& rng) {
  cv::Mat grey(size, CV_8U);
  rng.fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey < 256 * share;
}

// Filled ellipses, some reaching over the edge, with noise on top.
inline cv::Mat blob_mask(cv::Size size, int blobs, cv::RNG& rng) {
  cv::Mat mask = noise_mask(size, 0.02, rng);
  for (int i = 0; i < blobs; ++i) {
    const cv::Point centre(rng.uniform(0, size.width), rng.uniform(0, size.height));
    const cv::Size axes(rng.uniform(1, 3 + size.width / 6), rng.uniform(1, 3 + size.height / 6));
    cv::ellipse(mask, centre, axes, rng.uniform(0, 180), 0, 360, 255, cv::FILLED);
  }
  return mask;
}

}  // namespace nt::test
