// SPDX-License-Identifier: Apache-2.0
// The sequence numbers and timestamps of a live camera, made fit for use.
//
// A driver's count and clock -> a sequence that never goes back, whose gaps are dropped frames, and timestamps from 0 that
// always grow. A clock that steps back, runs ahead of ours or lies far behind it is replaced by ours for that frame; a count
// that stands still or leaps is taken as one frame more. Nanoseconds, steady clock; allocates nothing.
#pragma once
#include <algorithm>
#include <cstdint>

namespace nt {

class FrameClock {
 public:
  struct Stamp {
    uint64_t sequence = 0;
    int64_t timestamp_ns = 0;
  };

  Stamp take(uint32_t count, int64_t time_ns, int64_t now_ns) {
    const bool odd = time_ns > now_ns + kAhead_ns || time_ns < now_ns - kBehind_ns || (any_ && time_ns <= last_ns_);
    if (odd) ++odd_times_;
    int64_t at_ns = odd ? now_ns : time_ns;
    if (any_ && at_ns <= last_ns_) at_ns = last_ns_ + 1;
    if (!any_) epoch_ns_ = at_ns;
    else if (restarted_) sequence_ += 1 + lost(at_ns);
    else sequence_ += step(count - last_count_);
    any_ = true, restarted_ = false;
    last_count_ = count, last_ns_ = at_ns;
    return {sequence_, at_ns - epoch_ns_};
  }
  // Overtaken by the last one that was taken; farther behind it is a driver that counts anew.
  bool is_late(uint32_t count) const {
    const auto ahead = static_cast<int32_t>(count - last_count_);
    return any_ && !restarted_ && ahead < 0 && ahead > -kMostLate;
  }
  // The driver counts anew from here on: what was missed is told by the time that went by, at the rate of the frames so far, and
  // at most `fps`: in dim light, or asked for nothing, a camera films more slowly than it says.
  void restart(double fps) { restarted_ = any_, fps_ = fps; }

  int64_t epoch_ns() const { return epoch_ns_; }
  int64_t odd_times() const { return odd_times_; }

 private:
  static constexpr int64_t kAhead_ns = 100'000'000;  // what two processors' clocks and rounding may differ by, and more
  static constexpr int64_t kBehind_ns = 5'000'000'000;
  static constexpr int32_t kMostLate = 32;
  static constexpr uint64_t kEnough = 5;          // frames
  static constexpr uint32_t kMostStep = 100'000;  // an hour at 30 frames a second

  static uint64_t step(uint32_t counts) { return counts == 0 || counts > kMostStep ? 1 : counts; }
  uint64_t lost(int64_t at_ns) const {
    const double seen_s = static_cast<double>(last_ns_ - epoch_ns_) * 1e-9;
    const double fps = sequence_ >= kEnough ? std::min(static_cast<double>(sequence_) / seen_s, fps_) : fps_;
    const double frames = static_cast<double>(at_ns - last_ns_) * 1e-9 * fps;
    return frames > 1.5 ? static_cast<uint64_t>(frames - 0.5) : 0;
  }

  bool any_ = false, restarted_ = false;
  uint32_t last_count_ = 0;
  uint64_t sequence_ = 0;
  int64_t last_ns_ = 0, epoch_ns_ = 0, odd_times_ = 0;
  double fps_ = 0;
};

}  // namespace nt
