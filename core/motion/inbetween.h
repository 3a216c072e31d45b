// SPDX-License-Identifier: Apache-2.0
// Motions between two video frames, [F] section 5.3 ("we linearly interpolate 5 animation frames").
//
// Input: the motions of two frames and a fraction t in [0, 1]; output: the motion at that fraction, in the same units.
// Angles go the short way round, the centre goes straight. A fin that one of the two frames did not see is folded there
// (motion.h), so it opens or folds on the way; its confidence goes along. Status is that of the nearer frame.
// Differs from [F]: motions are interpolated rather than vertices, so bones keep their lengths in between.
// Cost: about 100 flops.
#pragma once
#include "core/motion/motion.h"

namespace nt {

inline constexpr int kInBetweens = 5;

// The k-th of `count` in-betweens lies at (k + 1) / (count + 1).
inline float in_between_fraction(int k, int count = kInBetweens) {
  return static_cast<float>(k + 1) / static_cast<float>(count + 1);
}

Motion in_between(const Motion& from, const Motion& to, float t);

}  // namespace nt
