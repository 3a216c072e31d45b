// SPDX-License-Identifier: Apache-2.0
// Precision, recall and F-measure of foreground masks against masks that are
// known to be right.
//
// Truth values as in CDnet 2014: 255 is foreground, 85 and 170 are not judged,
// everything else (0, and 50 for shadow) is background. Pixels of all frames of
// a clip are counted together.
#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace nt {

struct MaskScore {
  int64_t found = 0, invented = 0, missed = 0;  // pixels
  int frames = 0;
  void add(const cv::Mat& mask,
           const cv::Mat& truth);  // both 8-bit, of one size; mask: 0 is background
  void add(const MaskScore& other);
  double precision() const { return share(found, found + invented); }
  double recall() const { return share(found, found + missed); }
  double f_measure() const { return share(2 * found, 2 * found + invented + missed); }

 private:
  static double share(int64_t part, int64_t of) {
    return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 0;
  }
};

}  // namespace nt
