// SPDX-License-Identifier: Apache-2.0
// What a camera driver is asked, as the kernel has it: the seam behind which tests put a device that fails on purpose.
//
// Each call does what the system call of its name does: -1 (map: nullptr) and errno where it fails.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nt {

class VideoCalls {
 public:
  virtual ~VideoCalls() = default;
  virtual int open(const char* path) = 0;  // for reading and writing, without blocking
  virtual int close(int fd) = 0;
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
  virtual void* map(std::size_t bytes, int fd, int64_t offset) = 0;
  virtual int unmap(void* memory, std::size_t bytes) = 0;
  // The events at fd (POLLIN, POLLERR, ...), 0 when the time is over. fd -1: only waits.
  virtual int poll(int fd, int timeout_ms) = 0;
  virtual int64_t now_ns() = 0;                        // CLOCK_MONOTONIC
  virtual std::vector<std::string> video_nodes() = 0;  // "/dev/video0", ... in order of their numbers
};

VideoCalls& linux_video_calls();

}  // namespace nt
