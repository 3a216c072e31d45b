// SPDX-License-Identifier: Apache-2.0
// The simulated tank as a camera: frames 0, 1, 2, ... at exactly i / fps seconds, with their truth at hand.
//
// A tank larger than the working size is shrunk (area mean), as a file is; its truth stays in the tank's own pixels, the
// source's. Cost: the tank's own and, only then, the shrinking; else nothing is copied.
#pragma once
#include <opencv2/core/mat.hpp>

#include "platform/camera.h"
#include "platform/sim/half_chroma.h"
#include "platform/sim/tank.h"

namespace nt {

class SimCamera : public Camera {
 public:
  // frames < 0: without end.
  SimCamera(const TankSettings& settings, int64_t frames, int work_width, int work_height);
  const CameraInfo& info() const override { return info_; }
  std::optional<Frame> next() override;
  void give_chroma() override { with_chroma_ = true; }
  Picture picture() const override;
  bool rewind() override;
  const TankTruth* truth() override { return truth_with_mask(false); }
  // With mask and contour, which cost time.
  const TankTruth* truth_with_mask(bool with_mask = true);

 private:
  LumaView shrunk(const LumaView& luma);

  TankSettings settings_;
  CameraInfo info_;
  std::unique_ptr<Tank> tank_;
  bool with_chroma_ = false;
  HalfChroma chroma_;
  cv::Mat luma_;         // both only where the tank is larger than the working size
  mutable cv::Mat rgb_;  // made when it is asked for
};

// Throws UserError for an unknown scene (with the known ones), a size or a frame rate that cannot be.
std::unique_ptr<SimCamera> open_sim_camera(const TankSettings& settings, int64_t frames,
                                           int work_width = kTankMostWidth, int work_height = kTankMostHeight);

}  // namespace nt
