// SPDX-License-Identifier: Apache-2.0
// Clips whose masks are known: pictures in order, some of them with the true
// mask.
//
// A folder of clips in one of two layouts -> clips; a scene of the simulated
// tank -> a clip.
//   one video and groundtruth/gtNNNNNN.png     CDnet; gtN belongs to the
//   decoded frame N - 2, counted from 0 input/frame_K.jpg and
//   groundtruth/gtKKKK.png
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace nt {

struct MaskedFrame {
  cv::Mat bgr;
  cv::Mat truth;  // 8-bit, see mask_score.h; empty where it is not known
};

class MaskClip {
 public:
  virtual ~MaskClip() = default;
  virtual const std::string& name() const = 0;
  virtual bool next(MaskedFrame& frame) = 0;
  virtual void rewind() = 0;
};

// Every clip below `folder`, by name. Throws UserError where there is none.
std::vector<std::unique_ptr<MaskClip>> open_masked_clips(const std::string& folder);
// Truth in every fifth frame after the first second.
std::unique_ptr<MaskClip> open_tank_clip(const std::string& scene, int frames);

}  // namespace nt
