// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/half_chroma.h"

#include <opencv2/imgproc.hpp>

namespace nt {

void HalfChroma::give(const cv::Mat& picture, bool is_rgb, Frame& frame) {
  cv::resize(picture, half_, {(picture.cols + 1) / 2, (picture.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(half_, ycrcb_, is_rgb ? cv::COLOR_RGB2YCrCb : cv::COLOR_BGR2YCrCb);
  cv::extractChannel(ycrcb_, cr_, 1);
  cv::extractChannel(ycrcb_, cb_, 2);
  frame.cb = {cb_.data, cb_.cols, cb_.rows, static_cast<std::ptrdiff_t>(cb_.step[0])};
  frame.cr = {cr_.data, cr_.cols, cr_.rows, static_cast<std::ptrdiff_t>(cr_.step[0])};
}

}  // namespace nt
