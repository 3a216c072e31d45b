// SPDX-License-Identifier: Apache-2.0
// A file being written whose every error is seen: a missing folder, no permission, a disk that fills up.
//
// Bytes at offsets -> a file of the largest offset written. reserve() claims space ahead, so that a writer can stop while
// there is still room for what it must put at the end; what is claimed and not used is given back by close().
// Errors are POSIX numbers; error_line() makes the one line for the user.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace nt {

// Throws UserError where the folder of `path` is missing. None is made: a name that was mistyped would be one.
void expect_folder(const std::string& path);

class OutputFile {
 public:
  explicit OutputFile(std::string path);  // throws UserError when it cannot be opened
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  bool write_at(int64_t offset, std::span<const uint8_t> bytes);  // false: see error()
  bool reserve(int64_t size);                                     // false: the file cannot become that long
  bool close();                                                   // false: the data did not reach the disk
  int64_t size() const { return size_; }
  int error() const { return error_; }
  const std::string& path() const { return path_; }
  std::string error_line() const;  // "cannot write out.mp4: No space left on device"

 private:
  std::string path_;
  int descriptor_ = -1;
  int error_ = 0;
  int64_t size_ = 0, reserved_ = 0;
};

}  // namespace nt
