// SPDX-License-Identifier: Apache-2.0
#include "core/motion/order.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr uint8_t kKeptFromTurned = 1, kTurnedFromKept = 2;  // backpointers
// Even the surest continuation is wrong once in 10,000 frames, and one frame says no more than e^3.
constexpr float kSurest = 9.2f, kLoudest = 3.0f;

// log(p) for log odds x.
float log_share(float x) { return -det::log(1.0f + det::exp(-x)); }

}  // namespace

uint8_t OrderPass::add(const OrderStep& step) {
  const float evidence = det::clamp(step.evidence, -kLoudest, kLoudest);
  if (!started_) {
    started_ = true, lead_ = evidence;
    return 0;
  }
  const float odds = det::clamp(step.continues, -kSurest, kSurest);
  const float same = log_share(odds), other = log_share(-odds);
  // Likelihoods relative to the best path that ended turned.
  const float kept_kept = lead_ + same, turned_kept = other;
  const float kept_turned = lead_ + other, turned_turned = same;
  uint8_t back = 0;
  if (turned_kept > kept_kept) back |= kKeptFromTurned;
  if (kept_turned > turned_turned) back |= kTurnedFromKept;
  lead_ = det::max(kept_kept, turned_kept) - det::max(kept_turned, turned_turned) + evidence;
  return back;
}

void OrderPass::trace_back(std::span<uint8_t> steps) const {
  bool turned = lead_ < 0;
  for (std::size_t i = steps.size(); i-- > 0;) {
    const uint8_t back = steps[i];
    steps[i] = turned ? 1 : 0;
    turned = turned ? (back & kTurnedFromKept) == 0 : (back & kKeptFromTurned) != 0;
  }
}

}  // namespace nt
