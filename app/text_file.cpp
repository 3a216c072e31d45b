// SPDX-License-Identifier: Apache-2.0
#include "app/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "app/session.h"
#include "platform/camera.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr std::size_t kFlushAt = 64 * 1024;
constexpr int64_t kFlushEvery_ns = 1'000'000'000;  // what a killed program loses at most

}  // namespace

TextFile::TextFile(const std::string& path, Kind kind) : path_(path), is_stdout_(path == "-") {
  file_ = is_stdout_ ? STDOUT_FILENO : ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) throw UserError("cannot create " + path_ + ": " + std::strerror(errno) + "; check its folder");
  struct stat about {};
  keeps_rows_ = kind == Kind::rows && ::fstat(file_, &about) == 0 && S_ISREG(about.st_mode);
}

TextFile::~TextFile() {
  try {
    flush();
  } catch (const UserError&) {
    // The error that ends the program is already on its way.
  }
  if (file_ >= 0 && !is_stdout_) ::close(file_);
}

void TextFile::write(std::string_view text) {
  waiting_ += text;
  const int64_t now_ns = steady_now_ns();
  if (waiting_.size() < kFlushAt && now_ns < flushed_ns_ + kFlushEvery_ns) return;
  flushed_ns_ = now_ns;
  flush();
}

void TextFile::close() {
  flush();
  const int file = std::exchange(file_, -1);
  if (file >= 0 && !is_stdout_ && ::close(file) != 0) fail(errno);
}

void TextFile::flush() {
  std::size_t done = 0;
  while (done < waiting_.size() && file_ >= 0) {
    const ssize_t n = ::write(file_, waiting_.data() + done, waiting_.size() - done);
    if (n >= 0) {
      done += static_cast<std::size_t>(n);
      continue;
    }
    const int error = errno;
    if (error == EINTR) continue;
    if (error == EPIPE && is_stdout_) {
      file_ = -1;
      interrupt();
      break;
    }
    if (keeps_rows_) take_back_cut_row(done);
    fail(error);
  }
  waiting_.clear();
}

void TextFile::take_back_cut_row(std::size_t done) {
  // What follows the last line end of the part that was written.
  const std::size_t line_end = std::string_view(waiting_).substr(0, done).rfind('\n');
  const std::size_t cut = line_end == std::string_view::npos ? done : done - line_end - 1;
  const off_t size = ::lseek(file_, 0, SEEK_CUR);
  if (size < 0 || ::ftruncate(file_, size - static_cast<off_t>(cut)) != 0) keeps_rows_ = false;
}

void TextFile::fail(int error) {
  waiting_.clear();
  const std::string name = is_stdout_ ? "standard output" : path_;
  throw UserError("cannot write " + name + ": " + std::strerror(error) +
                  (keeps_rows_ ? "; complete rows up to here are kept" : ""));
}

void write_text(const std::string& path, std::string_view text) {
  TextFile file(path, TextFile::Kind::whole);
  file.write(text);
  file.close();
}

}  // namespace nt
