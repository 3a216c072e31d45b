// SPDX-License-Identifier: Apache-2.0
// What pictures a V4L2 device offers, and which of them to take.
//
// Device -> modes (format x size, with frame rates); modes and wishes -> one mode. Sizes in pixels, rates in frames a second.
// A device with steps in place of a list offers the usual sizes that fit, and the wished one.
// Without a wished size: the largest with no more pixels than are worked on, as long as it comes at the wished rate; else
// the smallest above. Raw pictures come before compressed ones, because they cost no decoding.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/linux/v4l2_device.h"

namespace nt {

enum class VideoFormat : uint8_t { nv12, yuyv, grey, mjpeg };  // in order of preference
inline constexpr VideoFormat kVideoFormats[] = {VideoFormat::nv12, VideoFormat::yuyv, VideoFormat::grey,
                                                VideoFormat::mjpeg};
const char* to_string(VideoFormat format);  // "nv12"
uint32_t fourcc_of(VideoFormat format);
std::optional<VideoFormat> format_of(uint32_t fourcc);

// Seconds a frame, as drivers count them.
struct FrameInterval {
  uint32_t numerator = 0, denominator = 0;
  double fps() const { return numerator > 0 ? static_cast<double>(denominator) / numerator : 0; }
};

struct VideoMode {
  VideoFormat format = VideoFormat::yuyv;
  int width = 0, height = 0;
  std::vector<FrameInterval> intervals;  // fastest first; empty: not known
  bool between = false;                  // any rate between the first and the last
};

struct VideoWish {
  std::optional<VideoFormat> format;
  int width = 0, height = 0;        // 0: as the rule above says
  double fps = 0;                   // 0: 30
  int64_t work_pixels = 960 * 544;  // that are worked on
};

std::vector<VideoMode> list_modes(const V4l2Device& device, const VideoWish& wish);
// The rate nearest to the wish; {0, 0} where the mode knows none.
FrameInterval nearest_interval(const VideoMode& mode, double fps);
// Throws UserError when nothing fits the wish, with what there is. Without any mode: one made of the wish.
VideoMode choose_mode(const std::string& path, const std::vector<VideoMode>& modes, const VideoWish& wish);
// "640x480 (30, 15 fps), 1280x720 (10 fps)" of one format.
std::string sizes_text(const std::vector<VideoMode>& modes, VideoFormat format);

}  // namespace nt
