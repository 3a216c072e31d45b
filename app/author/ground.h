// SPDX-License-Identifier: Apache-2.0
// A picture without transparency -> what in it is not the ground. Off the frame path.
//
// Input: RGBA pixels of a figure on an even ground: a flat colour, or paper photographed in uneven light. Output: a mask of
// the same size (255 = figures, filled), and for paper the pixels with the light evened out and the paper white.
// Method, [F] section 5 with more for photographs: Canny's edges; and what differs from the ground, whose colour is a
// quadratic surface fitted to the picture's rim, by Otsu's threshold. Both together are closed over gaps of up to 1/60 of
// the picture and filled. Cost: about 0.1 s for a megapixel.
#pragma once
#include <opencv2/core.hpp>

namespace nt {

struct Ground {
  cv::Mat mask;    // 8UC1
  cv::Mat pixels;  // 8UC4; as given unless the ground is paper
  bool paper = false;
};

Ground remove_ground(const cv::Mat& rgba);

}  // namespace nt
