// SPDX-License-Identifier: Apache-2.0
// A camera of libcamera's (those on a Raspberry Pi's ribbon cable, and USB cameras too) as a source of frames.
//
// ID -> frames at the working size, with the promises of v4l2_camera.h: settle, then lock; gaps counted; started once more
// after two seconds of silence, then the clip ends with a line. Luma is looked at where libcamera's buffers are mapped.
// libcamera is loaded with the first such camera: a late module (libneontetra_libcamera.so).
// Cost: one request a frame out of a fixed ring, and what VideoPixels costs.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "platform/camera.h"
#include "platform/linux/v4l2_camera.h"  // CameraManners

namespace nt {

struct LibcameraSettings {
  std::string id;             // whole, or a part of it; "": the first camera
  int width = 0, height = 0;  // 0: as many pixels as are worked on
  double fps = 0;             // 0: 30
  bool lock = true;
};

struct LibcameraEntry {
  std::string id, model;
};

// Both throw UserError where the module is missing; opening also when the camera cannot be had.
std::vector<LibcameraEntry> list_libcamera_cameras();
std::unique_ptr<Camera> open_libcamera_camera(const LibcameraSettings& settings, int work_width, int work_height,
                                              int64_t most_pixels, const CameraManners& manners);

}  // namespace nt
