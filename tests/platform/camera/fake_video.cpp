// SPDX-License-Identifier: Apache-2.0
#include "tests/platform/camera/fake_video.h"

#include <algorithm>

namespace nt::test {
namespace {

const std::map<unsigned long, std::string> kNames = {{VIDIOC_QUERYCAP, "VIDIOC_QUERYCAP"},
                                                     {VIDIOC_ENUM_FMT, "VIDIOC_ENUM_FMT"},
                                                     {VIDIOC_ENUM_FRAMESIZES, "VIDIOC_ENUM_FRAMESIZES"},
                                                     {VIDIOC_ENUM_FRAMEINTERVALS, "VIDIOC_ENUM_FRAMEINTERVALS"},
                                                     {VIDIOC_S_FMT, "VIDIOC_S_FMT"},
                                                     {VIDIOC_S_PARM, "VIDIOC_S_PARM"},
                                                     {VIDIOC_QUERYCTRL, "VIDIOC_QUERYCTRL"},
                                                     {VIDIOC_G_CTRL, "VIDIOC_G_CTRL"},
                                                     {VIDIOC_S_CTRL, "VIDIOC_S_CTRL"},
                                                     {VIDIOC_REQBUFS, "VIDIOC_REQBUFS"},
                                                     {VIDIOC_QUERYBUF, "VIDIOC_QUERYBUF"},
                                                     {VIDIOC_QBUF, "VIDIOC_QBUF"},
                                                     {VIDIOC_DQBUF, "VIDIOC_DQBUF"},
                                                     {VIDIOC_STREAMON, "VIDIOC_STREAMON"},
                                                     {VIDIOC_STREAMOFF, "VIDIOC_STREAMOFF"}};

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

void put_text(__u8* to, std::size_t most, const std::string& text) {
  std::memcpy(to, text.data(), std::min(most, text.size()));  // unterminated when full, as drivers may leave it
}

}  // namespace

int FakeVideo::ioctl(int, unsigned long request, void* argument) {
  const auto name = kNames.find(request);
  if (name == kNames.end()) return set(ENOTTY);
  if (const int error = failing(name->second)) return set(error);
  if (!plugged) return set(ENODEV);
  const int error = answer(request, argument);
  return error == 0 ? 0 : set(error);
}

int FakeVideo::answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& can = as<v4l2_capability>(argument);
      put_text(can.driver, sizeof can.driver, "fake");
      put_text(can.card, sizeof can.card, "Fake Camera");
      put_text(can.bus_info, sizeof can.bus_info, "usb-fake-1");
      can.capabilities = V4L2_CAP_DEVICE_CAPS | capabilities, can.device_caps = capabilities;
      return 0;
    }
    case VIDIOC_ENUM_FMT:
      return enumerate_format(as<v4l2_fmtdesc>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return enumerate_size(as<v4l2_frmsizeenum>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return enumerate_rate(as<v4l2_frmivalenum>(argument));
    case VIDIOC_S_FMT:
      return set_format(as<v4l2_format>(argument));
    case VIDIOC_S_PARM: {
      const v4l2_fract& interval = as<v4l2_streamparm>(argument).parm.capture.timeperframe;
      if (interval.numerator == 0 || interval.denominator == 0) return EINVAL;
      period_ns_ = int64_t{1'000'000'000} * interval.numerator / interval.denominator;
      return 0;
    }
    case VIDIOC_QUERYCTRL:
      return query_control(as<v4l2_queryctrl>(argument));
    case VIDIOC_G_CTRL:
    case VIDIOC_S_CTRL:
      return control(as<v4l2_control>(argument), request == VIDIOC_S_CTRL);
    case VIDIOC_REQBUFS:
      return request_buffers(as<v4l2_requestbuffers>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = as<v4l2_buffer>(argument);
      if (buffer.index >= buffers_.size() || buffers_[buffer.index] == nullptr) return EINVAL;
      buffer.length = static_cast<uint32_t>(buffers_[buffer.index]->size());
      buffer.m.offset = buffer.index;
      return 0;
    }
    case VIDIOC_QBUF: {
      const uint32_t index = as<v4l2_buffer>(argument).index;
      if (index >= buffers_.size() || std::find(queue_.begin(), queue_.end(), index) != queue_.end()) return EINVAL;
      queue_.push_back(index);
      return 0;
    }
    case VIDIOC_DQBUF:
      return take(as<v4l2_buffer>(argument));
    case VIDIOC_STREAMON:
      if (queue_.empty()) return EINVAL;
      streaming_ = true, sequence_ = 0;
      next_frame_ns_ = now_ns_ + period_ns_;
      return 0;
    default:  // VIDIOC_STREAMOFF
      streaming_ = false;
      queue_.clear();
      return 0;
  }
}

int FakeVideo::enumerate_format(v4l2_fmtdesc& format) const {
  if (format.index >= formats.size()) return EINVAL;
  format.pixelformat = std::next(formats.begin(), format.index)->first;
  return 0;
}

int FakeVideo::enumerate_size(v4l2_frmsizeenum& size) const {
  const auto found = formats.find(size.pixel_format);
  if (!lists_sizes || found == formats.end() || size.index >= found->second.size()) return EINVAL;
  size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
  size.discrete = {found->second[size.index].width, found->second[size.index].height};
  return 0;
}

int FakeVideo::enumerate_rate(v4l2_frmivalenum& rate) const {
  const auto found = formats.find(rate.pixel_format);
  if (found == formats.end()) return EINVAL;
  for (const FakeSize& size : found->second) {
    if (size.width != rate.width || size.height != rate.height || rate.index >= size.fps.size()) continue;
    rate.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    rate.discrete = {1, size.fps[rate.index]};
    return 0;
  }
  return EINVAL;
}

int FakeVideo::set_format(v4l2_format& format) {
  if (!buffers_.empty() && mappings > 0) return EBUSY;
  pix_ = format.fmt.pix;
  if (formats.count(pix_.pixelformat) == 0) pix_.pixelformat = formats.begin()->first;
  const bool yuyv = pix_.pixelformat == V4L2_PIX_FMT_YUYV, jpeg_coded = pix_.pixelformat == V4L2_PIX_FMT_MJPEG;
  pix_.bytesperline = jpeg_coded ? 0 : pix_.width * (yuyv ? 2 : 1) + 32;  // drivers pad rows
  const uint32_t rows = pix_.pixelformat == V4L2_PIX_FMT_NV12 ? pix_.height * 3 / 2 : pix_.height;
  pix_.sizeimage = jpeg_coded ? pix_.width * pix_.height * 2 + 4096 : pix_.bytesperline * rows;
  pix_.field = V4L2_FIELD_NONE, pix_.colorspace = V4L2_COLORSPACE_SRGB, pix_.quantization = quantization;
  format.fmt.pix = pix_;
  return 0;
}

int FakeVideo::query_control(v4l2_queryctrl& query) const {
  const bool next = (query.id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0;
  const uint32_t id = query.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
  const auto found = next ? controls.upper_bound(id) : controls.find(id);
  if (found == controls.end()) return EINVAL;
  query = {};
  query.id = found->first, query.type = V4L2_CTRL_TYPE_INTEGER;
  put_text(query.name, sizeof query.name, found->second.name);
  query.minimum = found->second.least, query.maximum = found->second.most, query.step = 1;
  return 0;
}

int FakeVideo::control(v4l2_control& control, bool write) {
  const auto found = controls.find(control.id);
  if (found == controls.end()) return EINVAL;
  if (!write) {
    control.value = found->second.value;
    return 0;
  }
  if (control.value < found->second.least || control.value > found->second.most) return ERANGE;
  found->second.value = control.value;
  return 0;
}

int FakeVideo::request_buffers(v4l2_requestbuffers& request) {
  request.count = std::min(request.count, most_buffers);
  buffers_.clear();
  queue_.clear();
  for (uint32_t i = 0; i < request.count; ++i)
    buffers_.push_back(std::make_unique<std::vector<uint8_t>>(pix_.sizeimage));
  return 0;
}

int FakeVideo::poll(int fd, int timeout_ms) {
  if (const int error = failing("poll")) return set(error);
  const int64_t end_ns = now_ns_ + timeout_ms * int64_t{1'000'000};
  each_wait(*this, now_ns_);
  if (fd >= 0 && !plugged) return POLLERR | POLLHUP;
  const bool comes = fd >= 0 && streaming_ && !silent && !queue_.empty();
  if (comes && next_frame_ns_ <= end_ns) {
    now_ns_ = std::max(now_ns_, next_frame_ns_);
    return POLLIN;
  }
  now_ns_ = end_ns;
  return 0;
}

int FakeVideo::take(v4l2_buffer& buffer) {
  if (!streaming_) return EINVAL;
  if (silent || queue_.empty() || now_ns_ < next_frame_ns_) return EAGAIN;
  // What there was no free buffer for is lost, as with a real driver.
  const int64_t ring_ns = static_cast<int64_t>(queue_.size() - 1) * period_ns_;
  while (next_frame_ns_ + ring_ns + period_ns_ <= now_ns_) next_frame_ns_ += period_ns_, ++sequence_;
  buffer.index = queue_.front();
  queue_.pop_front();
  std::vector<uint8_t> bytes = picture(sequence_);
  buffer.sequence = sequence_++;
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  buffer.timestamp.tv_sec = next_frame_ns_ / 1'000'000'000,
  buffer.timestamp.tv_usec = next_frame_ns_ % 1'000'000'000 / 1000;
  buffer.bytesused = static_cast<uint32_t>(bytes.size());
  next_frame_ns_ += period_ns_;
  ++frames_made;
  spoil(buffer, bytes);
  if (buffer.index < buffers_.size() && buffers_[buffer.index] != nullptr) {
    std::vector<uint8_t>& memory = *buffers_[buffer.index];
    std::memcpy(memory.data(), bytes.data(), std::min(memory.size(), bytes.size()));
  }
  return 0;
}

std::vector<uint8_t> FakeVideo::picture(uint32_t n) const {
  if (pix_.pixelformat == V4L2_PIX_FMT_MJPEG) return jpeg(n);
  std::vector<uint8_t> bytes(pix_.sizeimage, 128);
  const bool yuyv = pix_.pixelformat == V4L2_PIX_FMT_YUYV;
  for (int y = 0; y < static_cast<int>(pix_.height); ++y) {
    for (int x = 0; x < static_cast<int>(pix_.width); ++x) {
      const auto at = static_cast<std::size_t>(y) * pix_.bytesperline + static_cast<std::size_t>(yuyv ? 2 * x : x);
      bytes[at] = static_cast<uint8_t>(luma_at(x, y, n));
      if (yuyv) bytes[at + 1] = x % 2 == 0 ? 90 : 170;  // Cb, Cr
    }
  }
  for (std::size_t i = std::size_t{pix_.bytesperline} * pix_.height; !yuyv && i < bytes.size(); ++i)
    bytes[i] = i % 2 == 0 ? 90 : 170;
  return bytes;
}

}  // namespace nt::test
