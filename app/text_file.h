// SPDX-License-Identifier: Apache-2.0
// A text file, or standard output for "-", whose every write is checked.
//
// Rows go in whole. When the disk is full the file keeps its complete rows, and UserError says so in one line. Where
// something else ends the program early the destructor still writes the rows that wait.
// A reader of standard output that stops early (`neontetra bench | head -1`) is no error: the rest is dropped, and the program
// ends as by Ctrl-C. Rows wait for a second at most.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace nt {

class TextFile {
 public:
  enum class Kind { rows, whole };  // rows: a part of it is of use, so a failure says that it was kept
  explicit TextFile(const std::string& path, Kind kind = Kind::rows);  // throws UserError when it cannot be created
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void write(std::string_view text);
  void close();  // flushes and reports what the file system held back until now

 private:
  void flush();
  void take_back_cut_row(std::size_t done);
  [[noreturn]] void fail(int error);

  std::string path_;
  std::string waiting_;
  int64_t flushed_ns_ = 0;
  int file_ = -1;
  bool is_stdout_ = false;
  bool keeps_rows_ = false;  // rows, in a regular file: not a pipe or a device
};

// Writes all of `text` to a file or, for "-", standard output.
void write_text(const std::string& path, std::string_view text);

}  // namespace nt
