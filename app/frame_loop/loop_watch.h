// SPDX-License-Identifier: Apache-2.0
// Looks after a running frame loop: says when the machine is slowed down, and at the end what the loop left out.
#pragma once
#include <cstdio>
#include <string>

#include "app/export/report.h"
#include "app/frame_loop/capture_loop.h"
#include "platform/linux/clock.h"
#include "platform/linux/throttling.h"

namespace nt {

class LoopWatch {
 public:
  // As often as one likes.
  void look() {
    const std::string line = throttling_.look(steady_now_ns());
    if (!line.empty()) std::fprintf(stderr, "%s\n", line.c_str());
  }
  const ThrottleState& machine() const { return throttling_.state(); }

  // "loop" of the report.
  Json json(const CaptureLoop& loop) const {
    const ThrottleState& state = machine();
    return {{"frames_not_stored", loop.not_stored()},
            {"pictures_not_stored", loop.pictures_not_stored()},
            {"frames_not_shown", loop.not_shown()},
            {"slowed_down", throttling_.times()},
            {"hottest_c", state.knows_heat ? Json(state.hottest_c) : Json(nullptr)}};
  }

 private:
  ThrottleWatch throttling_;
};

}  // namespace nt
