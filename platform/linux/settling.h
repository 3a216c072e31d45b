// SPDX-License-Identifier: Apache-2.0
// When a camera that sets its own exposure has come to rest: settle, then lock.
//
// Brightness of each frame (mean luma) and its time -> settled or not. Settled: over the last ten frames it moved by less
// than one grey level, or three seconds are over, because a picture with a swimming fish need never rest. After the lock a
// few frames are let go by, which some cameras still expose in the old way. Allocates nothing.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace nt {

class Settling {
 public:
  // One frame more; true when the camera may be locked, and again when it was locked and its pictures can be used.
  bool settled(double brightness, int64_t time_ns) {
    if (locked_) return ++since_lock_ >= kAfterLock;
    if (seen_ == 0) first_ns_ = time_ns;
    last_[seen_++ % kCalmFrames] = brightness;
    if (time_ns - first_ns_ > kLongest_ns) return true;
    if (seen_ < kCalmFrames) return false;
    const auto [least, most] = std::minmax_element(last_, last_ + kCalmFrames);
    return *most - *least < kCalm;
  }
  void set_locked() { locked_ = true; }
  bool locked() const { return locked_; }

 private:
  static constexpr std::size_t kCalmFrames = 10;
  static constexpr double kCalm = 1.0;  // grey levels
  static constexpr int64_t kLongest_ns = 3'000'000'000;
  static constexpr int kAfterLock = 3;

  double last_[kCalmFrames] = {};
  std::size_t seen_ = 0;
  int64_t first_ns_ = 0;
  bool locked_ = false;
  int since_lock_ = 0;
};

}  // namespace nt
