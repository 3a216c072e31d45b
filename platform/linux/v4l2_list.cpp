// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_list.h"

#include <cerrno>

namespace nt {
namespace {

enum class Door : uint8_t { open, shut, none };

// A node that may not be opened could be a camera; any other failure means that it is none, or gone again.
Door knock(VideoCalls& calls, const std::string& path) {
  const int fd = calls.open(path.c_str());
  const int error = errno;
  if (fd >= 0) calls.close(fd);
  if (fd >= 0) return Door::open;
  return error == EACCES || error == EPERM || error == EBUSY ? Door::shut : Door::none;
}

}  // namespace

std::vector<ListedCamera> list_v4l2_cameras(VideoCalls& calls) {
  std::vector<ListedCamera> cameras;
  for (const std::string& path : calls.video_nodes()) {
    ListedCamera camera;
    camera.path = path;
    const Door door = knock(calls, path);
    if (door == Door::none) continue;
    try {
      const V4l2Device device(calls, path);
      camera.card = device.card(), camera.driver = device.driver(), camera.bus = device.bus();
      camera.modes = list_modes(device, {});
      camera.controls = list_controls(device);
      if (camera.modes.empty()) camera.problem = path + ": it lists no pictures as nv12, yuyv, grey or mjpeg";
    } catch (const UserError& error) {
      if (door == Door::open) continue;  // it opens, so it is no camera
      camera.problem = error.what();
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace nt
