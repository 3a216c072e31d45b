// SPDX-License-Identifier: Apache-2.0
// The V4L2 cameras of this machine: what they are called, what they offer, what stands in the way of using them.
//
// Nodes that give no pictures (a webcam's second node, decoders, radio) are left out. Nothing is changed on a camera.
#pragma once
#include <string>
#include <vector>

#include "platform/linux/v4l2_controls.h"
#include "platform/linux/v4l2_modes.h"

namespace nt {

struct ListedCamera {
  std::string path, card, driver, bus;
  std::vector<VideoMode> modes;
  std::vector<CameraControl> controls;
  std::string problem;  // one line; empty where it can be opened
};
std::vector<ListedCamera> list_v4l2_cameras(VideoCalls& calls = linux_video_calls());

}  // namespace nt
