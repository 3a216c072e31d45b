// SPDX-License-Identifier: Apache-2.0
// An open video device: what it is, its calls with errors that say what to do.
//
// A failing call becomes one line: the device, what was tried, the call and the system's word for it, what to do.
// Cost: none but the calls. Source: the kernel's "Video for Linux API" (linux/videodev2.h).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "platform/camera.h"
#include "platform/linux/video_calls.h"

namespace nt {

// The line for a call that failed; exit code 3. `doing`: "setting the picture format"; `call`: "VIDIOC_S_FMT".
UserError video_error(const std::string& path, const std::string& doing, const std::string& call, int error);
// The device is not there any more: unplugged.
bool means_unplugged(int error);

class V4l2Device {
 public:
  // Throws UserError: not there, not allowed, no camera.
  V4l2Device(VideoCalls& calls, const std::string& path);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  VideoCalls& calls() const { return calls_; }
  int fd() const { return fd_; }
  const std::string& path() const { return path_; }
  const std::string& card() const { return card_; }      // "HD Webcam: HD Webcam"
  const std::string& driver() const { return driver_; }  // "uvcvideo"
  const std::string& bus() const { return bus_; }        // "usb-0000:00:14.0-1"

  // 0, or the error number. A signal does not disturb it.
  int try_call(unsigned long request, void* argument) const;
  void call(unsigned long request, void* argument, const char* name, const char* doing) const;  // throws UserError

 private:
  void check_capture();

  VideoCalls& calls_;
  std::string path_, card_, driver_, bus_;
  int fd_ = -1;
};

}  // namespace nt
