// SPDX-License-Identifier: Apache-2.0
#include "platform/late_module.h"
#include "platform/linux/libcamera_camera.h"

namespace nt {
namespace {

void* function(const char* name) {
  static const LateModule module("libneontetra_libcamera.so", "which speaks to libcamera");
  return module.function(name);
}

}  // namespace

std::vector<LibcameraEntry> list_libcamera_cameras() {
  using List = void (*)(std::vector<LibcameraEntry>&);
  std::vector<LibcameraEntry> list;
  reinterpret_cast<List>(function("neontetra_list_libcamera"))(list);
  return list;
}

std::unique_ptr<Camera> open_libcamera_camera(const LibcameraSettings& settings, int work_width, int work_height,
                                              int64_t most_pixels, const CameraManners& manners) {
  using Open = Camera* (*)(const LibcameraSettings&, int, int, int64_t, const CameraManners&);
  const auto open = reinterpret_cast<Open>(function("neontetra_open_libcamera"));
  return std::unique_ptr<Camera>(open(settings, work_width, work_height, most_pixels, manners));
}

}  // namespace nt
