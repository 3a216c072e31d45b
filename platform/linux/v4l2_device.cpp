// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_device.h"

#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

namespace nt {
namespace {

constexpr int kMostInterrupts = 100;  // a call that is interrupted more often than this will never end

struct Advice {
  int error;
  const char* text;
};

constexpr const char* kAnswersBadly =
    "the camera answers badly: check the cable and the power of the USB hub, or plug it in anew";

constexpr Advice kAdvice[] = {
    {EBUSY, "another program has the camera: end that one, or take another camera"},
    {EACCES, "you may not use it: join the group video ('sudo usermod -aG video $USER'), then log in again"},
    {EPERM, "you may not use it: join the group video ('sudo usermod -aG video $USER'), then log in again"},
    {ENOENT, "there is no such camera: check the cable; 'neontetra --list-cameras' shows what there is"},
    {ENODEV, "it was unplugged: plug it in again"},
    {ENXIO, "it was unplugged: plug it in again"},
    {EINVAL, "its driver refuses this: try another size, fps or format ('neontetra --list-cameras' shows them)"},
    {ENOTTY, "its driver cannot do this: take another camera ('neontetra --list-cameras')"},
    {EIO, kAnswersBadly},
    {EPROTO, kAnswersBadly},
    {EPIPE, kAnswersBadly},
    {ETIMEDOUT, kAnswersBadly},
    {ENOMEM, "the system has no memory for its pictures: choose a smaller size"},
    {ENOSPC, "the USB bus cannot carry that much: choose a smaller size, a lower fps or format=mjpeg, or another port"},
    {EMFILE, "too many files are open: raise 'ulimit -n'"},
    {ENFILE, "too many files are open: end other programs"},
};

const char* advice_for(int error) {
  for (const Advice& advice : kAdvice) {
    if (advice.error == error) return advice.text;
  }
  return "plug it in anew; if that does not help, report this line";
}

// A driver's text, which need not end with a zero.
template <std::size_t N>
std::string text_of(const __u8 (&bytes)[N]) {
  const char* text = reinterpret_cast<const char*>(bytes);
  return {text, strnlen(text, N)};
}

}  // namespace

UserError video_error(const std::string& path, const std::string& doing, const std::string& call, int error) {
  return UserError(path + ": " + doing + " failed (" + call + ": " + std::strerror(error) + "); " + advice_for(error),
                   3);
}

bool means_unplugged(int error) { return error == ENODEV || error == ENXIO; }

V4l2Device::V4l2Device(VideoCalls& calls, const std::string& path) : calls_(calls), path_(path) {
  fd_ = calls_.open(path.c_str());
  if (fd_ < 0) throw video_error(path, "opening the camera", "open", errno);
  try {
    check_capture();
  } catch (...) {
    calls_.close(fd_);
    throw;
  }
}

V4l2Device::~V4l2Device() { calls_.close(fd_); }

void V4l2Device::check_capture() {
  v4l2_capability can{};
  const int error = try_call(VIDIOC_QUERYCAP, &can);
  if (error == ENOTTY || error == EINVAL)
    throw UserError(path_ + ": this is no video device; 'neontetra --list-cameras' shows the cameras there are", 3);
  if (error != 0) throw video_error(path_, "asking what it is", "VIDIOC_QUERYCAP", error);
  card_ = text_of(can.card), driver_ = text_of(can.driver), bus_ = text_of(can.bus_info);
  const __u32 flags = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  if ((flags & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    const bool planes = (flags & (V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_VIDEO_M2M_MPLANE)) != 0;
    throw UserError(path_ + " (" + card_ + "): " +
                        (planes ? "this is a part of a camera chain; use libcamera for it, --camera libcamera"
                                : "it gives no pictures; 'neontetra --list-cameras' shows the cameras there are"),
                    3);
  }
  if ((flags & V4L2_CAP_STREAMING) == 0)
    throw UserError(path_ + " (" + card_ + "): its driver cannot stream; take another camera", 3);
}

int V4l2Device::try_call(unsigned long request, void* argument) const {
  for (int i = 0; i < kMostInterrupts; ++i) {
    if (calls_.ioctl(fd_, request, argument) >= 0) return 0;
    if (errno != EINTR) return errno;
  }
  return EINTR;
}

void V4l2Device::call(unsigned long request, void* argument, const char* name, const char* doing) const {
  const int error = try_call(request, argument);
  if (error != 0) throw video_error(path_, doing, name, error);
}

}  // namespace nt
