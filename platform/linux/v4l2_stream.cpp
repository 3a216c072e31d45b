// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_stream.h"

#include <linux/videodev2.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace nt {
namespace {

constexpr uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
constexpr uint32_t kLeastRing = 2;  // one that we look at, one that the driver fills
constexpr double kUsualFps = 30;
constexpr int kPause_ms = 5;
constexpr uint32_t kLargestSide = 8192, kSmallestSide = 16;

// As videodev2.h's own macros say, which C++ cannot use for the enums.
bool is_limited(const v4l2_pix_format& pix, VideoFormat format) {
  if (format == VideoFormat::grey || format == VideoFormat::mjpeg) return false;  // sensors and JPEG use the full range
  if (pix.priv == V4L2_PIX_FMT_PRIV_MAGIC && pix.quantization != V4L2_QUANTIZATION_DEFAULT)
    return pix.quantization == V4L2_QUANTIZATION_LIM_RANGE;
  return pix.colorspace != V4L2_COLORSPACE_JPEG;
}

v4l2_buffer buffer_request(uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = kCapture, buffer.memory = V4L2_MEMORY_MMAP, buffer.index = index;
  return buffer;
}

std::string fourcc_text(uint32_t fourcc) {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const char c = static_cast<char>(fourcc >> (8 * i) & 0x7f);
    text += c >= ' ' && c < 0x7f ? c : '?';
  }
  return text;
}

}  // namespace

std::size_t VideoLayout::least_bytes() const {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  const auto s = static_cast<std::size_t>(stride);
  switch (format) {
    case VideoFormat::nv12:
      return s * h + s * ((h + 1) / 2 - 1) + (w + 1) / 2 * 2;
    case VideoFormat::yuyv:
      return s * (h - 1) + 2 * w;
    case VideoFormat::grey:
      return s * (h - 1) + w;
    case VideoFormat::mjpeg:
      break;
  }
  return 4;  // the marks of begin and end
}

V4l2Stream::V4l2Stream(VideoCalls& calls, const std::string& path, const VideoWish& wish) : device_(calls, path) {
  const VideoMode mode = choose_mode(path, list_modes(device_, wish), wish);
  set_format(mode);
  set_rate(mode, wish);
}

V4l2Stream::~V4l2Stream() {
  stop();
  unmap_ring();
}

void V4l2Stream::set_format(const VideoMode& mode) {
  v4l2_format format{};
  format.type = kCapture;
  v4l2_pix_format& pix = format.fmt.pix;
  pix.width = static_cast<uint32_t>(mode.width), pix.height = static_cast<uint32_t>(mode.height);
  pix.pixelformat = fourcc_of(mode.format);
  pix.field = V4L2_FIELD_NONE;
  pix.priv = V4L2_PIX_FMT_PRIV_MAGIC;
  device_.call(VIDIOC_S_FMT, &format, "VIDIOC_S_FMT", "setting the picture format");
  const std::string name = device_.path() + " (" + device_.card() + "): ";
  const std::optional<VideoFormat> got = format_of(pix.pixelformat);
  if (!got)
    throw UserError(name + "it gives pictures as '" + fourcc_text(pix.pixelformat) +
                        "', which cannot be read; nv12, yuyv, grey and mjpeg can",
                    3);
  if (pix.field == V4L2_FIELD_ALTERNATE)
    throw UserError(name + "it gives half pictures in turn (interlaced); choose a progressive mode of it", 3);
  const bool whole_pairs = *got == VideoFormat::grey || *got == VideoFormat::mjpeg ||
                           (pix.width % 2 == 0 && (*got == VideoFormat::yuyv || pix.height % 2 == 0));
  const bool side_ok = whole_pairs && std::min(pix.width, pix.height) >= kSmallestSide &&
                       std::max(pix.width, pix.height) <= kLargestSide;
  const std::string size = std::to_string(pix.width) + "x" + std::to_string(pix.height);
  if (!side_ok) throw UserError(name + "pictures of " + size + " pixels cannot be used; choose another size", 3);
  layout_.format = *got;
  layout_.width = static_cast<int>(pix.width), layout_.height = static_cast<int>(pix.height);
  const uint32_t row = *got == VideoFormat::mjpeg ? 0 : pix.width * (*got == VideoFormat::yuyv ? 2 : 1);
  constexpr uint32_t kMostStride = 1 << 20;
  layout_.stride = static_cast<int>(row == 0 ? 0 : std::clamp(pix.bytesperline, row, kMostStride));
  layout_.limited = is_limited(pix, *got);
}

void V4l2Stream::set_rate(const VideoMode& mode, const VideoWish& wish) {
  const double wished = wish.fps > 0 ? wish.fps : kUsualFps;
  FrameInterval interval = nearest_interval(mode, wished);
  if (interval.numerator == 0) interval = {1000, static_cast<uint32_t>(std::lround(wished * 1000))};
  v4l2_streamparm rate{};
  rate.type = kCapture;
  rate.parm.capture.timeperframe = {interval.numerator, interval.denominator};
  const int error = device_.try_call(VIDIOC_S_PARM, &rate);
  // A camera with one fixed rate need not know this call.
  if (error != 0 && error != ENOTTY && error != EINVAL)
    throw video_error(device_.path(), "setting the frame rate", "VIDIOC_S_PARM", error);
  const v4l2_fract& got = rate.parm.capture.timeperframe;
  if (error == 0 && got.numerator > 0 && got.denominator > 0) interval = {got.numerator, got.denominator};
  fps_ = std::clamp(interval.fps(), 0.1, 1000.0);
}

void V4l2Stream::map_ring() {
  v4l2_requestbuffers request{};
  request.count = kRing, request.type = kCapture, request.memory = V4L2_MEMORY_MMAP;
  device_.call(VIDIOC_REQBUFS, &request, "VIDIOC_REQBUFS", "asking for picture buffers");
  if (request.count < kLeastRing)
    throw UserError(device_.path() + ": its driver gives " + std::to_string(request.count) +
                        " picture buffers, 2 are needed; choose a smaller size",
                    3);
  // A driver may give more than was asked for; those are left alone.
  for (ring_size_ = 0; ring_size_ < std::min(request.count, kRing); ++ring_size_) {
    v4l2_buffer buffer = buffer_request(ring_size_);
    device_.call(VIDIOC_QUERYBUF, &buffer, "VIDIOC_QUERYBUF", "looking for a picture buffer");
    if (buffer.length < layout_.least_bytes())
      throw UserError(device_.path() + ": its driver's buffers of " + std::to_string(buffer.length) +
                          " bytes are too small for a picture; choose another size or format",
                      3);
    void* memory = device_.calls().map(buffer.length, device_.fd(), buffer.m.offset);
    if (memory == nullptr) throw video_error(device_.path(), "mapping a picture buffer", "mmap", errno);
    ring_[ring_size_] = {memory, buffer.length};
  }
}

void V4l2Stream::unmap_ring() {
  for (Buffer& buffer : ring_) {
    if (buffer.memory != nullptr) device_.calls().unmap(buffer.memory, buffer.bytes);
    buffer = {};
  }
  ring_size_ = 0;
}

int V4l2Stream::queue(uint32_t index) const {
  v4l2_buffer buffer = buffer_request(index);
  return device_.try_call(VIDIOC_QBUF, &buffer);
}

void V4l2Stream::start() {
  if (ring_size_ == 0) {
    try {
      map_ring();
    } catch (...) {
      unmap_ring();
      throw;
    }
  }
  queue_error_ = 0;
  for (uint32_t i = 0; i < ring_size_; ++i) {
    const int error = queue(i);
    if (error != 0) throw video_error(device_.path(), "handing over a picture buffer", "VIDIOC_QBUF", error);
  }
  int type = kCapture;
  device_.call(VIDIOC_STREAMON, &type, "VIDIOC_STREAMON", "starting the camera");
  streaming_ = true;
}

void V4l2Stream::stop() {
  if (ring_size_ == 0) return;
  int type = kCapture;
  device_.try_call(VIDIOC_STREAMOFF, &type);  // there is nothing to do about a failure: the device is about to go
  streaming_ = false;
}

bool V4l2Stream::ready(int timeout_ms, bool& unplugged) const {
  const int events = device_.calls().poll(device_.fd(), timeout_ms);
  if (events < 0 && errno != EINTR && errno != EAGAIN)
    throw video_error(device_.path(), "waiting for a picture", "poll", errno);
  if (events <= 0) return false;
  unplugged = (events & (POLLHUP | POLLNVAL)) != 0;
  return !unplugged;  // POLLERR: what it is, VIDIOC_DQBUF says
}

V4l2Stream::Got V4l2Stream::take(int timeout_ms, RawFrame& frame) {
  if (means_unplugged(queue_error_)) return Got::unplugged;
  if (queue_error_ != 0)
    throw video_error(device_.path(), "handing over a picture buffer", "VIDIOC_QBUF", queue_error_);
  bool unplugged = false;
  if (!ready(timeout_ms, unplugged)) return unplugged ? Got::unplugged : Got::nothing;
  v4l2_buffer buffer = buffer_request(0);
  const int error = device_.try_call(VIDIOC_DQBUF, &buffer);
  if (means_unplugged(error)) return Got::unplugged;
  if (error == EAGAIN || error == EINTR) {  // it said that there is one: do not ask it over and over
    device_.calls().poll(-1, std::min(timeout_ms, kPause_ms));
    return Got::nothing;
  }
  // The kernel says of EIO: a signal lost for a while; the buffer stays in the ring.
  if (error == EIO) return Got::damaged;
  if (error != 0) throw video_error(device_.path(), "taking a picture", "VIDIOC_DQBUF", error);
  frame.sequence = buffer.sequence;
  const bool monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  frame.timestamp_ns = monotonic ? buffer.timestamp.tv_sec * int64_t{1'000'000'000} + buffer.timestamp.tv_usec * 1000
                                 : device_.calls().now_ns();
  return look_at(buffer.index, buffer.bytesused, buffer.flags, frame);
}

V4l2Stream::Got V4l2Stream::look_at(uint32_t index, uint32_t bytes_used, uint32_t flags, RawFrame& frame) {
  if (index >= ring_size_) return Got::damaged;
  frame.index = index;
  frame.bytes = {static_cast<const uint8_t*>(ring_[index].memory),
                 std::min<std::size_t>(bytes_used, ring_[index].bytes)};
  if ((flags & V4L2_BUF_FLAG_ERROR) == 0 && frame.bytes.size() >= layout_.least_bytes()) return Got::frame;
  give_back(frame);
  return Got::damaged;
}

void V4l2Stream::give_back(const RawFrame& frame) {
  const int error = queue(frame.index);
  if (error != 0) queue_error_ = error;
}

}  // namespace nt
