// SPDX-License-Identifier: Apache-2.0
// When the next frame of a recorded clip is due, and how many came too late to be shown.
//
// Time now -> skips. Frames that are late are skipped to keep the clip's own speed, but at most kMostSkips in one go:
// where decoding itself is too slow, skipping costs more time than it wins, and whoever plays must get back to the
// window. Then the clip goes on from now, slower than it was filmed. With `kept` frames a clip stands for a camera, whose
// driver keeps so many: one that is not later than that is shown, and what finds more waiting goes to the
// newest. Nanoseconds; allocates nothing.
#pragma once
#include <cstdint>

namespace nt {

class Pacer {
 public:
  static constexpr int kMostSkips = 8;

  explicit Pacer(int64_t period_ns, int64_t kept = 0) : period_ns_(period_ns > 0 ? period_ns : 1), kept_(kept) {}
  int64_t period_ns() const { return period_ns_; }
  void start(int64_t now_ns) { due_ns_ = now_ns; }
  int64_t due_ns() const { return due_ns_; }
  bool due(int64_t now_ns) const { return now_ns >= due_ns_; }
  // How many take() would pass over.
  int64_t skips(int64_t now_ns) const {
    const int64_t late = periods_late(now_ns);
    return late > kMostSkips ? kMostSkips : late;
  }
  // A frame is taken now; returns how many to pass over before it.
  int take(int64_t now_ns) {
    const int64_t late = periods_late(now_ns);
    const bool hopeless = late > kMostSkips;
    due_ns_ = (hopeless ? now_ns : due_ns_ + late * period_ns_) + period_ns_;
    return hopeless ? kMostSkips : static_cast<int>(late);
  }

 private:
  int64_t periods_late(int64_t now_ns) const {
    const int64_t late = now_ns > due_ns_ ? (now_ns - due_ns_) / period_ns_ : 0;
    return late > kept_ ? late : 0;
  }
  int64_t period_ns_, kept_;
  int64_t due_ns_ = 0;
};

}  // namespace nt
