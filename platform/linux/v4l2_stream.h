// SPDX-License-Identifier: Apache-2.0
// A V4L2 device that streams: format, frame rate and a fixed ring of buffers that the driver fills and we only look at.
//
// Wishes -> pictures as the driver left them (nothing is copied here). Every buffer taken is given back; the memory is
// mapped once. Cost: two system calls a frame, kRing mapped pictures.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "platform/linux/v4l2_device.h"
#include "platform/linux/v4l2_modes.h"

namespace nt {

// A picture as it lies in memory.
struct VideoLayout {
  VideoFormat format = VideoFormat::yuyv;
  int width = 0, height = 0;        // pixels
  int stride = 0;                   // bytes from one row to the next; 0: compressed
  bool limited = false;             // luma runs from 16 to 235, else from 0 to 255
  std::size_t least_bytes() const;  // of a whole picture
};

struct RawFrame {
  std::span<const uint8_t> bytes;
  uint32_t index = 0;        // of the buffer, for give_back
  uint32_t sequence = 0;     // the driver's count
  int64_t timestamp_ns = 0;  // the driver's, monotonic clock; our own where it has another
};

class V4l2Stream {
 public:
  static constexpr uint32_t kRing = 4;
  enum class Got : uint8_t { frame, damaged, nothing, unplugged };

  // Opens and negotiates; does not stream yet. Throws UserError.
  V4l2Stream(VideoCalls& calls, const std::string& path, const VideoWish& wish);
  ~V4l2Stream();
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;

  const V4l2Device& device() const { return device_; }
  const VideoLayout& layout() const { return layout_; }
  double fps() const { return fps_; }
  bool streaming() const { return streaming_; }

  void start();  // throws UserError
  void stop();   // all buffers come back
  // Waits for the next picture, at most timeout_ms. `damaged`: the driver says that it is; it was given back already.
  Got take(int timeout_ms, RawFrame& frame);
  void give_back(const RawFrame& frame);  // to be filled again; a failure shows in the next take

 private:
  struct Buffer {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };

  void set_format(const VideoMode& mode);
  void set_rate(const VideoMode& mode, const VideoWish& wish);
  void map_ring();
  void unmap_ring();
  bool ready(int timeout_ms, bool& unplugged) const;
  Got look_at(uint32_t index, uint32_t bytes_used, uint32_t flags, RawFrame& frame);
  int queue(uint32_t index) const;  // 0 or the error number

  V4l2Device device_;
  VideoLayout layout_;
  double fps_ = 0;
  Buffer ring_[kRing];
  uint32_t ring_size_ = 0;
  bool streaming_ = false;
  int queue_error_ = 0;
};

}  // namespace nt
