// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/video_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr std::string_view kNode = "video";

// The number of "video7"; -1 for other names.
int node_number(const std::string& name) {
  int number = -1;
  if (!name.starts_with(kNode)) return -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + kNode.size(), end, number);
  return error == std::errc() && stop == end ? number : -1;
}

class LinuxVideoCalls : public VideoCalls {
 public:
  int open(const char* path) override { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); }
  int close(int fd) override { return ::close(fd); }
  int ioctl(int fd, unsigned long request, void* argument) override { return ::ioctl(fd, request, argument); }
  void* map(std::size_t bytes, int fd, int64_t offset) override {
    void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  int unmap(void* memory, std::size_t bytes) override { return ::munmap(memory, bytes); }
  int poll(int fd, int timeout_ms) override {
    pollfd one{fd, POLLIN, 0};
    const int ready = ::poll(&one, 1, timeout_ms);
    return ready > 0 ? one.revents : ready;
  }
  int64_t now_ns() override { return steady_now_ns(); }
  std::vector<std::string> video_nodes() override {
    std::vector<int> numbers;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/dev", error)) {
      const int number = node_number(entry.path().filename().string());
      if (number >= 0) numbers.push_back(number);
    }
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::string> paths;
    for (const int number : numbers) paths.push_back("/dev/video" + std::to_string(number));
    return paths;
  }
};

}  // namespace

VideoCalls& linux_video_calls() {
  static LinuxVideoCalls calls;
  return calls;
}

}  // namespace nt
