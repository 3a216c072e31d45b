// SPDX-License-Identifier: Apache-2.0
// The memory of a camera's picture, readable here: planes in one file -> bytes from the first plane on.
//
// Cost: one mmap for each picture buffer, once; two ioctls a frame where the buffer is a dma-buf.
#pragma once
#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace nt {

struct PictureMemory {
  int fd = -1;
  std::size_t offset = 0, length = 0;  // of a plane in the file
};

class PlaneMapping {
 public:
  explicit PlaneMapping(std::span<const PictureMemory> planes) : fd_(planes[0].fd) {
    for (const PictureMemory& plane : planes) {
      length_ = std::max(length_, plane.offset + plane.length);
      one_file_ = one_file_ && plane.fd == fd_;
    }
    if (planes.size() > 1) chroma_at_ = planes[1].offset - planes[0].offset;
    memory_ = mmap(nullptr, length_, PROT_READ, MAP_SHARED, fd_, 0);
    bytes_ = {static_cast<const uint8_t*>(memory_) + planes[0].offset, length_ - planes[0].offset};
  }
  ~PlaneMapping() {
    if (memory_ != MAP_FAILED) munmap(memory_, length_);
  }
  PlaneMapping(const PlaneMapping&) = delete;
  PlaneMapping& operator=(const PlaneMapping&) = delete;
  bool ok() const { return memory_ != MAP_FAILED && one_file_; }
  std::optional<std::size_t> chroma_at() const { return chroma_at_; }  // bytes behind the first plane
  std::span<const uint8_t> bytes() const { return bytes_; }
  // The processor's caches and the camera's writes; not every buffer knows this call.
  void begin_reading() const { sync(DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ); }
  void end_reading() const { sync(DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ); }

 private:
  void sync(uint64_t flags) const {
    dma_buf_sync request{flags};
    if (ioctl(fd_, DMA_BUF_IOCTL_SYNC, &request) < 0) return;
  }

  int fd_;
  std::size_t length_ = 0;
  bool one_file_ = true;
  std::optional<std::size_t> chroma_at_;
  void* memory_ = MAP_FAILED;
  std::span<const uint8_t> bytes_;
};

}  // namespace nt
