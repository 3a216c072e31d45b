// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_modes.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace nt {
namespace {

constexpr double kUsualFps = 30;
constexpr uint32_t kMostListed = 64;  // of sizes and rates: a driver that goes on for ever is cut short
constexpr uint32_t kMostFormats = 256;
constexpr int kUsualSizes[][2] = {{320, 240}, {640, 360},  {640, 480},  {800, 600},
                                  {960, 540}, {1280, 720}, {1920, 1080}};
constexpr int kWorkWidth = 960, kWorkHeight = 544;

struct Pair {
  VideoFormat format;
  const char* name;
  uint32_t fourcc;
};
constexpr Pair kFormats[] = {{VideoFormat::nv12, "nv12", V4L2_PIX_FMT_NV12},
                             {VideoFormat::yuyv, "yuyv", V4L2_PIX_FMT_YUYV},
                             {VideoFormat::grey, "grey", V4L2_PIX_FMT_GREY},
                             {VideoFormat::mjpeg, "mjpeg", V4L2_PIX_FMT_MJPEG}};

FrameInterval interval_of(const v4l2_fract& f) { return {f.numerator, f.denominator}; }

void add_intervals(const V4l2Device& device, VideoMode& mode) {
  for (uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_frmivalenum rate{};
    rate.index = i, rate.pixel_format = fourcc_of(mode.format);
    rate.width = static_cast<uint32_t>(mode.width), rate.height = static_cast<uint32_t>(mode.height);
    if (device.try_call(VIDIOC_ENUM_FRAMEINTERVALS, &rate) != 0) break;
    if (rate.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
      mode.intervals = {interval_of(rate.stepwise.min), interval_of(rate.stepwise.max)};
      mode.between = true;
      break;
    }
    mode.intervals.push_back(interval_of(rate.discrete));
  }
  std::erase_if(mode.intervals, [](const FrameInterval& i) { return i.numerator == 0 || i.denominator == 0; });
  std::sort(mode.intervals.begin(), mode.intervals.end(),
            [](const FrameInterval& a, const FrameInterval& b) { return a.fps() > b.fps(); });
}

void add_size(const V4l2Device& device, VideoFormat format, int64_t width, int64_t height,
              std::vector<VideoMode>& modes) {
  constexpr int64_t kMostSide = 16384;
  if (width <= 0 || height <= 0 || width > kMostSide || height > kMostSide) return;
  VideoMode mode;
  mode.format = format, mode.width = static_cast<int>(width), mode.height = static_cast<int>(height);
  for (const VideoMode& other : modes) {
    if (other.format == format && other.width == mode.width && other.height == mode.height) return;
  }
  add_intervals(device, mode);
  modes.push_back(std::move(mode));
}

void add_steps(const V4l2Device& device, VideoFormat format, const v4l2_frmsize_stepwise& range, const VideoWish& wish,
               std::vector<VideoMode>& modes) {
  const auto fits = [](int side, uint32_t least, uint32_t most, uint32_t step) {
    const auto value = static_cast<uint32_t>(side);
    return value >= least && value <= most && (step <= 1 || (value - least) % step == 0);
  };
  const auto add = [&](int width, int height) {
    if (width > 0 && height > 0 && fits(width, range.min_width, range.max_width, range.step_width) &&
        fits(height, range.min_height, range.max_height, range.step_height))
      add_size(device, format, width, height, modes);
  };
  for (const auto& size : kUsualSizes) add(size[0], size[1]);
  add(wish.width, wish.height);
  add_size(device, format, range.max_width, range.max_height, modes);
}

void add_sizes(const V4l2Device& device, VideoFormat format, const VideoWish& wish, std::vector<VideoMode>& modes) {
  for (uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_frmsizeenum size{};
    size.index = i, size.pixel_format = fourcc_of(format);
    if (device.try_call(VIDIOC_ENUM_FRAMESIZES, &size) != 0) return;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) return add_steps(device, format, size.stepwise, wish, modes);
    add_size(device, format, size.discrete.width, size.discrete.height, modes);
  }
}

double best_fps(const VideoMode& mode, double wished) {
  const FrameInterval interval = nearest_interval(mode, wished);
  return interval.numerator > 0 ? interval.fps() : wished;
}

// Smaller is better: fast enough first, then the size, then the format.
auto rank(const VideoMode& mode, const VideoWish& wish) {
  const double wished = wish.fps > 0 ? wish.fps : kUsualFps;
  const double slow = std::max(0.0, wished * 0.9 - best_fps(mode, wished));
  const int64_t pixels = int64_t{1} * mode.width * mode.height;
  const int64_t over = std::max<int64_t>(0, pixels - wish.work_pixels);
  return std::make_tuple(slow, over, -pixels, mode.format);
}

[[noreturn]] void refuse(const std::string& path, const std::vector<VideoMode>& modes, const VideoWish& wish) {
  std::string offers;
  for (const VideoFormat format : kVideoFormats) {
    const std::string sizes = sizes_text(modes, format);
    if (!sizes.empty()) offers += (offers.empty() ? "" : "; ") + std::string(to_string(format)) + ": " + sizes;
  }
  std::string wished = wish.width > 0 ? std::to_string(wish.width) + "x" + std::to_string(wish.height) : "";
  if (wish.format) wished += (wished.empty() ? "" : " ") + std::string(to_string(*wish.format));
  throw UserError(path + ": the camera has no " + wished + "; it offers " + offers, 3);
}

}  // namespace

const char* to_string(VideoFormat format) {
  for (const Pair& pair : kFormats) {
    if (pair.format == format) return pair.name;
  }
  return "";
}

uint32_t fourcc_of(VideoFormat format) {
  for (const Pair& pair : kFormats) {
    if (pair.format == format) return pair.fourcc;
  }
  return 0;
}

std::optional<VideoFormat> format_of(uint32_t fourcc) {
  for (const Pair& pair : kFormats) {
    if (pair.fourcc == fourcc) return pair.format;
  }
  if (fourcc == V4L2_PIX_FMT_JPEG) return VideoFormat::mjpeg;
  return std::nullopt;
}

std::vector<VideoMode> list_modes(const V4l2Device& device, const VideoWish& wish) {
  std::vector<VideoMode> modes;
  for (uint32_t i = 0; i < kMostFormats; ++i) {
    v4l2_fmtdesc offered{};
    offered.index = i, offered.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.try_call(VIDIOC_ENUM_FMT, &offered) != 0) break;
    const std::optional<VideoFormat> format = format_of(offered.pixelformat);
    if (format) add_sizes(device, *format, wish, modes);
  }
  return modes;
}

FrameInterval nearest_interval(const VideoMode& mode, double fps) {
  if (mode.intervals.empty()) return {};
  if (mode.between && fps <= mode.intervals.front().fps() && fps >= mode.intervals.back().fps())
    return {1000, static_cast<uint32_t>(std::lround(fps * 1000))};
  return *std::min_element(mode.intervals.begin(), mode.intervals.end(),
                           [fps](const FrameInterval& a, const FrameInterval& b) {
                             return std::abs(a.fps() - fps) < std::abs(b.fps() - fps);
                           });
}

VideoMode choose_mode(const std::string& path, const std::vector<VideoMode>& modes, const VideoWish& wish) {
  const VideoMode* best = nullptr;
  for (const VideoMode& mode : modes) {
    if (wish.format && mode.format != *wish.format) continue;
    if (wish.width > 0 && (mode.width != wish.width || mode.height != wish.height)) continue;
    if (best == nullptr || rank(mode, wish) < rank(*best, wish)) best = &mode;
  }
  if (best != nullptr) return *best;
  if (!modes.empty()) refuse(path, modes, wish);
  VideoMode asked;  // a driver that lists nothing may still agree
  asked.format = wish.format.value_or(VideoFormat::yuyv);
  asked.width = wish.width > 0 ? wish.width : kWorkWidth;
  asked.height = wish.width > 0 ? wish.height : kWorkHeight;
  return asked;
}

std::string sizes_text(const std::vector<VideoMode>& modes, VideoFormat format) {
  std::string text;
  for (const VideoMode& mode : modes) {
    if (mode.format != format) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(mode.width) + "x" + std::to_string(mode.height);
    std::string rates;
    for (const FrameInterval& interval : mode.intervals) {
      char rate[32];
      std::snprintf(rate, sizeof rate, "%.4g", interval.fps());
      rates += (rates.empty() ? "" : mode.between ? " to " : ", ") + std::string(rate);
    }
    if (!rates.empty()) text += " (" + rates + " fps)";
  }
  return text;
}

}  // namespace nt
