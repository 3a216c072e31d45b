// SPDX-License-Identifier: Apache-2.0
// What a run counts, in fixed memory however long it lasts.
#pragma once
#include <array>
#include <cstdint>

#include "core/pipeline/pipeline.h"

namespace nt {

// Times in buckets 1/16 octave wide (4.4 % apart), from 1 ns to over an hour: quantiles to 2.2 %, 2.7 KB.
class TimeHistogram {
 public:
  void add(int64_t ns);
  double quantile_ns(double q) const;  // q in [0, 1]; 0 when empty
  int64_t count() const { return count_; }
  int64_t max_ns() const { return max_; }

 private:
  static constexpr int kPerOctave = 16;
  static constexpr int kOctaves = 42;
  std::array<uint32_t, kPerOctave * kOctaves> buckets_{};
  int64_t count_ = 0;
  int64_t max_ = 0;
};

inline constexpr int kStatuses = 6;
inline constexpr int kFlags = 8;
extern const char* const kFlagNames[kFlags];  // in the order of StepFlag's bits

struct Statistics {
  int64_t frames = 0;
  int64_t poses = 0;                           // frames with a pose
  int64_t allocations_after_frame_0 = 0;       // inside Capture::step
  int most_blobs = 0;                          // in one frame
  int64_t dropped = 0;                         // gaps in the camera's own count
  std::array<int64_t, kStatuses> by_status{};  // in the order of PoseStatus
  std::array<int64_t, kFlags> by_flag{};
  std::array<int64_t, kMostFish> poses_of_fish{};  // by number
  std::array<TimeHistogram, kStages> stages;
  TimeHistogram total;
  TimeHistogram latency;        // from the camera's timestamp to the motion; empty where frames are not waited for
  int64_t rss_start_bytes = 0;  // of the process, after the first frame

  void add(const StepReport& report);
};

}  // namespace nt
