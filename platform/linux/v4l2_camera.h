// SPDX-License-Identifier: Apache-2.0
// A V4L2 camera (USB webcams, capture cards) as a source of frames.
//
// Device -> frames at the working size (the largest with the camera's aspect that fits; never larger than the camera's).
// Timestamps are the driver's, from 0 at the first frame; sequence numbers are the driver's too, so that a gap is a dropped
// frame. The first frames are spent on letting exposure and white balance settle; then they are locked.
// A camera that is unplugged is waited for; one that falls silent is started once more; then the clip ends and failure()
// says why. Damaged pictures are passed over and counted. A clock that jumps is replaced by our own for that frame.
// Cost: two system calls a frame and what VideoPixels costs; nothing is allocated after the first frame.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "platform/camera.h"
#include "platform/linux/v4l2_controls.h"
#include "platform/linux/v4l2_modes.h"
#include "platform/linux/video_calls.h"

namespace nt {

struct V4l2Settings {
  std::string path = "/dev/video0";
  VideoWish wish;
  bool lock = true;
  Mains mains = Mains::leave;
  double wait_s = 10;  // for a camera that was unplugged
};

// How a live camera talks to whoever runs it.
struct CameraManners {
  std::function<bool()> stop = [] { return false; };  // the user wants to end: next() returns nothing
  std::function<void(const std::string&)> say = [](const std::string&) {};  // what happened, one line
};

// Throws UserError when the camera cannot be had as wished for.
std::unique_ptr<Camera> open_v4l2_camera(const V4l2Settings& settings, int work_width, int work_height,
                                         int64_t most_pixels, const CameraManners& manners,
                                         VideoCalls& calls = linux_video_calls());

}  // namespace nt
