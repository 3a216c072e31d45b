// SPDX-License-Identifier: Apache-2.0
// A V4L2 device made of memory: formats, controls, a ring and a clock of its own, and failures where a test wants them.
//
// Time passes only while somebody waits in poll(). Picture n shows kFirst + (x + 3 y + 7 n) % kSpan in luma; see luma_at().
#pragma once
#include <linux/videodev2.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "platform/linux/video_calls.h"

namespace nt::test {

struct FakeSize {
  uint32_t width, height;
  std::vector<uint32_t> fps;
};
struct FakeControl {
  std::string name;
  int32_t least, most, value;
};

class FakeVideo : public VideoCalls {
 public:
  static constexpr int kFirst = 20, kSpan = 200;
  static int luma_at(int x, int y, uint32_t n) { return kFirst + static_cast<int>((x + 3 * y + 7 * n) % kSpan); }

  std::map<uint32_t, std::vector<FakeSize>> formats{{V4L2_PIX_FMT_YUYV, {{64, 48, {30, 15}}, {128, 96, {10}}}}};
  std::map<uint32_t, FakeControl> controls;
  uint32_t quantization = V4L2_QUANTIZATION_FULL_RANGE;
  uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  uint32_t most_buffers = 32;
  bool plugged = true, lists_sizes = true;
  bool silent = false;                                   // streams, but no picture comes
  std::function<std::vector<uint8_t>(uint32_t n)> jpeg;  // picture n, where the format is MJPEG
  // Asked before each call, with its name: the error number it fails with, 0 for none.
  std::function<int(const std::string& call)> fail = [](const std::string&) { return 0; };
  // A picture is about to be handed over.
  std::function<void(v4l2_buffer& buffer, std::vector<uint8_t>& bytes)> spoil = [](v4l2_buffer&,
                                                                                   std::vector<uint8_t>&) {};
  std::function<void(FakeVideo&, int64_t now_ns)> each_wait = [](FakeVideo&, int64_t) {};

  int open_files = 0, mappings = 0, calls_made = 0;
  uint32_t frames_made = 0;

  ~FakeVideo() override = default;
  int open(const char*) override {
    if (const int error = failing("open")) return set(error);
    if (!plugged) return set(ENOENT);
    ++open_files;
    ++opened_;
    return 1000 + opened_;
  }
  int close(int) override {
    --open_files;
    streaming_ = false;
    queue_.clear();
    return 0;
  }
  void* map(std::size_t bytes, int, int64_t offset) override {
    if (const int error = failing("mmap")) return set(error), nullptr;
    auto& buffer = buffers_.at(static_cast<std::size_t>(offset));
    if (buffer == nullptr || buffer->size() != bytes) return set(EINVAL), nullptr;
    ++mappings;
    return buffer->data();
  }
  int unmap(void* memory, std::size_t) override {
    --mappings;
    for (auto& buffer : buffers_) {
      if (buffer != nullptr && buffer->data() == memory) buffer.reset();  // reading on is an error that ASan sees
    }
    return 0;
  }
  int poll(int fd, int timeout_ms) override;
  int64_t now_ns() override { return now_ns_; }
  std::vector<std::string> video_nodes() override { return {"/dev/video0"}; }
  int ioctl(int fd, unsigned long request, void* argument) override;

  void unplug() { plugged = false; }
  void advance(int64_t ns) { now_ns_ += ns; }

 private:
  int failing(const std::string& call) {
    ++calls_made;
    return fail(call);
  }
  int set(int error) {
    errno = error;
    return -1;
  }
  int enumerate_format(v4l2_fmtdesc& format) const;
  int enumerate_size(v4l2_frmsizeenum& size) const;
  int enumerate_rate(v4l2_frmivalenum& rate) const;
  int set_format(v4l2_format& format);
  int query_control(v4l2_queryctrl& query) const;
  int control(v4l2_control& control, bool write);
  int request_buffers(v4l2_requestbuffers& request);
  int take(v4l2_buffer& buffer);
  int answer(unsigned long request, void* argument);
  std::vector<uint8_t> picture(uint32_t n) const;

  int64_t now_ns_ = 1'000'000'000'000, next_frame_ns_ = 0, period_ns_ = 33'333'333;
  int opened_ = 0;
  bool streaming_ = false;
  uint32_t sequence_ = 0;
  v4l2_pix_format pix_{};
  std::vector<std::unique_ptr<std::vector<uint8_t>>> buffers_;
  std::deque<uint32_t> queue_;
};

}  // namespace nt::test
