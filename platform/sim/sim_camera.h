// SPDX-License-Identifier: Apache-2.0
// The simulated tank as a camera: frames 0, 1, 2, ... at exactly i / fps seconds, with their truth at hand.
//
// Cost: the tank's own; it renders into its own buffers, nothing is copied.
#pragma once
#include "platform/camera.h"
#include "platform/sim/tank.h"

namespace nt {

class SimCamera : public Camera {
 public:
  SimCamera(const TankSettings& settings, int64_t frames);  // frames < 0: without end
  const CameraInfo& info() const override { return info_; }
  std::optional<Frame> next() override;
  Picture picture() const override;
  bool rewind() override;
  // Of the frame handed out last; null before the first. Mask and contour only when asked for.
  const TankTruth* truth(bool with_mask = false);

 private:
  TankSettings settings_;
  CameraInfo info_;
  std::unique_ptr<Tank> tank_;
};

// Throws UserError for an unknown scene (with the known ones), a size or a frame rate that cannot be.
std::unique_ptr<SimCamera> open_sim_camera(const TankSettings& settings, int64_t frames);

}  // namespace nt
