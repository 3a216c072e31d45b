// SPDX-License-Identifier: Apache-2.0
// While it lives nothing comes out on standard error: libpng and libjpeg print there whatever OpenCV is told, and a failure
// of ours is one line. It holds for the whole process, so it should live for one call only.
// Cost: four system calls.
#pragma once
#include <fcntl.h>
#include <unistd.h>

namespace nt {

class QuietStderr {
 public:
  QuietStderr() : saved_(dup(STDERR_FILENO)) {
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null >= 0) {
      dup2(null, STDERR_FILENO);
      close(null);
    }
  }
  ~QuietStderr() {
    if (saved_ < 0) return;
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int saved_;
};

}  // namespace nt
