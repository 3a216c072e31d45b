// SPDX-License-Identifier: Apache-2.0
#include "app/statistics.h"

#include <algorithm>
#include <cmath>

namespace nt {

const char* const kFlagNames[kFlags] = {"runs_dropped", "blobs_dropped",     "contour_cut",    "frame_too_large",
                                        "relearned",    "head_tail_swapped", "shadow_removed", "stabilised"};

void TimeHistogram::add(int64_t ns) {
  const double octaves = ns > 1 ? std::log2(static_cast<double>(ns)) : 0.0;
  const int bucket = static_cast<int>(octaves * kPerOctave);
  ++buckets_[static_cast<std::size_t>(std::clamp(bucket, 0, kPerOctave * kOctaves - 1))];
  max_ = std::max(max_, ns);
  ++count_;
}

double TimeHistogram::quantile_ns(double q) const {
  const int64_t rank = static_cast<int64_t>(q * static_cast<double>(count_ - 1));
  int64_t below = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    below += buckets_[i];
    if (below > rank) return std::exp2((static_cast<double>(i) + 0.5) / kPerOctave);
  }
  return 0;
}

void Statistics::add(const StepReport& report) {
  ++frames;
  if (report.status == PoseStatus::ok) ++poses;
  ++by_status[static_cast<std::size_t>(report.status)];
  most_blobs = std::max(most_blobs, report.blobs);
  for (std::size_t bit = 0; bit < kFlags; ++bit) {
    if ((report.flags >> bit & 1u) != 0) ++by_flag[bit];
  }
  for (std::size_t s = 0; s < kStages; ++s) stages[s].add(report.times.ns[s]);
  total.add(report.times.total());
}

}  // namespace nt
