// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_controls.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace nt {
namespace {

constexpr int kMostControls = 256;  // a driver that goes on for ever is cut short

struct Automatic {
  uint32_t id;
  int32_t off;
  const char* name;
  uint32_t held;  // what it governs, written back as it stands; 0: nothing
};
// In this order: with exposure still automatic some cameras refuse a gain.
constexpr Automatic kAutomatic[] = {
    {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, "exposure", V4L2_CID_EXPOSURE_ABSOLUTE},
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0, "", 0},  // else the frame rate falls in dim light
    {V4L2_CID_AUTOGAIN, 0, "gain", V4L2_CID_GAIN},
    {V4L2_CID_AUTO_WHITE_BALANCE, 0, "white balance", V4L2_CID_WHITE_BALANCE_TEMPERATURE},
    {V4L2_CID_FOCUS_AUTO, 0, "focus", V4L2_CID_FOCUS_ABSOLUTE},
};

bool read_control(const V4l2Device& device, uint32_t id, int32_t& value) {
  v4l2_control control{id, 0};
  if (device.try_call(VIDIOC_G_CTRL, &control) != 0) return false;
  value = control.value;
  return true;
}

bool write_control(const V4l2Device& device, uint32_t id, int32_t value) {
  v4l2_control control{id, value};
  return device.try_call(VIDIOC_S_CTRL, &control) == 0;
}

bool is_on(const V4l2Device& device, const Automatic& automatic, int32_t& value) {
  return read_control(device, automatic.id, value) && value != automatic.off &&
         !(automatic.id == V4L2_CID_EXPOSURE_AUTO && value == V4L2_EXPOSURE_SHUTTER_PRIORITY);
}

std::string plain_name(const char* text, std::size_t most) {
  std::string name(text, strnlen(text, most));
  std::string plain;
  for (const char c : name) {
    const bool word = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (word) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!plain.empty() && plain.back() != '_') plain += '_';
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  return plain;
}

}  // namespace

std::vector<CameraControl> list_controls(const V4l2Device& device) {
  std::vector<CameraControl> controls;
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  for (int i = 0; i < kMostControls && device.try_call(VIDIOC_QUERYCTRL, &query) == 0; ++i) {
    const bool number = query.type == V4L2_CTRL_TYPE_INTEGER || query.type == V4L2_CTRL_TYPE_BOOLEAN ||
                        query.type == V4L2_CTRL_TYPE_MENU || query.type == V4L2_CTRL_TYPE_INTEGER_MENU;
    if (number && (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0) {
      CameraControl control{query.id,
                            plain_name(reinterpret_cast<const char*>(query.name), sizeof query.name),
                            query.minimum,
                            query.maximum,
                            query.step,
                            query.default_value,
                            0};
      int32_t value = 0;
      if (read_control(device, query.id, value)) control.value = value;
      controls.push_back(std::move(control));
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  return controls;
}

void set_mains(const V4l2Device& device, Mains mains) {
  if (mains == Mains::leave) return;
  constexpr int32_t kValues[] = {0, V4L2_CID_POWER_LINE_FREQUENCY_DISABLED, V4L2_CID_POWER_LINE_FREQUENCY_50HZ,
                                 V4L2_CID_POWER_LINE_FREQUENCY_60HZ, V4L2_CID_POWER_LINE_FREQUENCY_AUTO};
  v4l2_control control{V4L2_CID_POWER_LINE_FREQUENCY, kValues[static_cast<std::size_t>(mains)]};
  const int error = device.try_call(VIDIOC_S_CTRL, &control);
  if (error == 0) return;
  if (error == EINVAL || error == ERANGE || error == ENOTTY)
    throw UserError(
        device.path() + " (" + device.card() + "): the camera has no such filter for lamps; leave out mains=", 3);
  throw video_error(device.path(), "setting the mains' frequency", "VIDIOC_S_CTRL", error);
}

bool ControlLock::wanted(const V4l2Device& device) {
  int32_t value = 0;
  return std::any_of(std::begin(kAutomatic), std::end(kAutomatic),
                     [&](const Automatic& automatic) { return is_on(device, automatic, value); });
}

std::string ControlLock::lock(const V4l2Device& device) {
  std::string locked;
  for (const Automatic& automatic : kAutomatic) {
    int32_t before = 0, held = 0;
    if (!is_on(device, automatic, before)) continue;
    const bool has_value = automatic.held != 0 && read_control(device, automatic.held, held);
    if (!write_control(device, automatic.id, automatic.off)) continue;
    changes_.push_back({automatic.id, before});
    // Some cameras fall back to their default once they are told to keep still.
    if (has_value) write_control(device, automatic.held, held);
    if (*automatic.name != '\0') locked += (locked.empty() ? "" : ", ") + std::string(automatic.name);
  }
  return locked;
}

void ControlLock::release(const V4l2Device& device) {
  for (const Change& change : changes_) write_control(device, change.id, change.before);
  changes_.clear();
}

}  // namespace nt
