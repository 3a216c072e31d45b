// SPDX-License-Identifier: Apache-2.0
// A file as bytes in memory, read by the kernel page by page when they are looked at: nothing is copied.
//
// Path -> its bytes, starting on a page, for reading, for as long as this lives. Another file may be renamed over it
// meanwhile; one that is cut off in place is not to be looked at behind its new end (the process would get SIGBUS).
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace nt {

class MappedFile {
 public:
  // None where there is no such file, no right to read it, or it is no file (a folder, a pipe).
  static std::optional<MappedFile> open(const std::string& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> bytes_;  // empty: nothing is mapped
};

}  // namespace nt
