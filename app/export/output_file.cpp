// SPDX-License-Identifier: Apache-2.0
#include "app/export/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

#include "platform/camera.h"

namespace nt {

void expect_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code unused;
  if (!folder.empty() && !std::filesystem::is_directory(folder, unused))
    throw UserError("cannot write " + path + ": there is no folder " + folder.string() + "; create it first");
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  // A process limit on file sizes would otherwise kill us instead of giving an error.
  static const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  static_cast<void>(ignored);
  expect_folder(path_);
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) return;
  error_ = errno;
  throw UserError(error_line());
}

OutputFile::~OutputFile() { close(); }

bool OutputFile::write_at(int64_t offset, std::span<const uint8_t> bytes) {
  if (descriptor_ < 0) return false;
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      error_ = written < 0 ? errno : ENOSPC;
      return false;
    }
    offset += written;
    size_ = std::max(size_, offset);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool OutputFile::reserve(int64_t size) {
  if (size <= reserved_) return true;
  if (descriptor_ < 0) return false;
#ifdef __linux__
  // Not posix_fallocate: where the file system cannot reserve, that would write the space.
  if (fallocate(descriptor_, 0, 0, size) != 0) {
    if (errno != ENOSPC && errno != EFBIG && errno != EDQUOT) return true;  // no reserving here: a write will tell
    error_ = errno;
    return false;
  }
#endif
  reserved_ = size;
  return true;
}

bool OutputFile::close() {
  if (descriptor_ < 0) return error_ == 0;
  struct stat status {};
  // A device or a pipe has no length to cut.
  if (fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > size_ &&
      ftruncate(descriptor_, size_) != 0 && error_ == 0) {
    error_ = errno;
  }
  if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  descriptor_ = -1;
  return error_ == 0;
}

std::string OutputFile::error_line() const {
  return "cannot write " + path_ + ": " + std::generic_category().message(error_);
}

}  // namespace nt
