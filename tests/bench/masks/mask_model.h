// SPDX-License-Identifier: Apache-2.0
// What makes the masks that are scored: Neontetra's background models as
// capture runs them, and OpenCV's MOG2 and KNN as peers. One picture in, one
// opened mask (3 x 3, as capture opens) out.
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "app/aligned_block.h"

namespace nt {

class MaskModel {
 public:
  virtual ~MaskModel() = default;
  virtual const std::string& name() const = 0;
  virtual std::size_t bytes() const { return 0; }  // that the model takes; 0: not known
  // Some of the clip's pictures, spread over it, before the first one. Only
  // `still` looks.
  virtual void learn(const std::vector<cv::Mat>&) {}
  // 8-bit, 0 is background. False where the picture was only learned from. `us`
  // is the model's own time.
  virtual bool apply(const cv::Mat& bgr, cv::Mat& mask, double& us) = 0;
};

// Every model, for pictures of this size.
std::vector<std::unique_ptr<MaskModel>> make_mask_models(cv::Size size);

}  // namespace nt
