// SPDX-License-Identifier: Apache-2.0
// A V4L2 camera on a fake device, and what was said.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "platform/linux/v4l2_camera.h"
#include "tests/platform/camera/fake_video.h"

namespace nt::test {

struct Said {
  std::vector<std::string> lines;
  bool has(const std::string& part) const {
    for (const std::string& line : lines) {
      if (line.find(part) != std::string::npos) return true;
    }
    return false;
  }
};

inline std::unique_ptr<Camera> open_fake(FakeVideo& video, const V4l2Settings& settings = {}, Said* said = nullptr,
                                         int work_width = 8192, int work_height = 8192) {
  CameraManners manners;
  if (said != nullptr) manners.say = [said](const std::string& line) { said->lines.push_back(line); };
  return open_v4l2_camera(settings, work_width, work_height, 0, manners, video);
}

// The line that opening or the first frame fails with; empty when it does not.
inline std::string failure_of(FakeVideo& video, const V4l2Settings& settings = {}) {
  try {
    const std::unique_ptr<Camera> camera = open_fake(video, settings);
    (void)camera->next();
    return camera->failure();
  } catch (const UserError& error) {
    return error.what();
  }
}

}  // namespace nt::test
