// SPDX-License-Identifier: Apache-2.0
// Time per stage. Core has no clock: the platform hands in a function, or null.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace nt {

using NowNs = int64_t (*)();

enum class Stage : uint8_t {
  stabilise,
  background,
  clean,
  components,
  target,
  refine,
  outline,
  landmarks,
  motion,
  count
};
inline constexpr std::size_t kStages = static_cast<std::size_t>(Stage::count);
inline constexpr const char* kStageNames[kStages] = {"stabilise", "background", "clean",     "components", "target",
                                                     "refine",    "outline",    "landmarks", "motion"};

struct StageTimes {
  std::array<int64_t, kStages> ns{};
  int64_t total() const {
    int64_t sum = 0;
    for (int64_t v : ns) sum += v;
    return sum;
  }
};

// Charges the time since the last lap to a stage.
class StageClock {
 public:
  StageClock(NowNs now, StageTimes& times) : now_(now), times_(times), last_(now != nullptr ? now() : 0) {}
  void lap(Stage stage) {
    if (now_ == nullptr) return;
    const int64_t t = now_();
    times_.ns[static_cast<std::size_t>(stage)] += t - last_;
    last_ = t;
  }

 private:
  NowNs now_;
  StageTimes& times_;
  int64_t last_;
};

}  // namespace nt
