// SPDX-License-Identifier: Apache-2.0
// A camera's controls: listed, and those locked that would change the picture while it is watched.
//
// A background model learns the empty tank; a camera that brightens or tints the picture by itself makes all of it new.
// So exposure, gain, white balance and focus settle by themselves first and are then held where they are, and given back to
// the camera at the end. What somebody has set by hand (it is off already) is left alone.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "platform/linux/v4l2_device.h"

namespace nt {

struct CameraControl {
  uint32_t id = 0;
  std::string name;  // "exposure_time_absolute", as v4l2-ctl spells it
  int64_t least = 0, most = 0, step = 0, usual = 0, value = 0;
};
std::vector<CameraControl> list_controls(const V4l2Device& device);

// The mains' frequency, against lamps that flicker.
enum class Mains : uint8_t { leave, off, hz50, hz60, automatic };
void set_mains(const V4l2Device& device, Mains mains);  // throws UserError where the camera cannot

class ControlLock {
 public:
  // Something is on that can be locked.
  static bool wanted(const V4l2Device& device);
  // What was locked, for people: "exposure, white balance"; empty when nothing was.
  std::string lock(const V4l2Device& device);
  void release(const V4l2Device& device);  // as it was before; errors are ignored, the device may be gone

 private:
  struct Change {
    uint32_t id;
    int32_t before;
  };
  std::vector<Change> changes_;
};

}  // namespace nt
