// SPDX-License-Identifier: Apache-2.0
// FishPose -> intermediate motion M, [F] Eq 14 and Algorithm 2.
//
// Angles are of each bone in the fish-local frame: x to the fish's right, y towards its head, so a straight fish has
// up-axis and head angles at pi/2, low-axis and tail angles at -pi/2 ([F] Table 2). Radians, kept continuous over time:
// each angle is unwrapped against the last frame's, never jumps by 2 pi. `dir_rad` is atan2(dir.y, dir.x) in image
// coordinates (y down), unwrapped too.
// Differs from [F]: a fin that was not seen is folded against the body; it takes its folded angle and confidence 0.
// Cost: one atan2 per bone (23 by default), about 1 microsecond.
#pragma once
#include <cstdint>

#include "core/landmarks/fish_pose.h"

namespace nt {

struct Motion {
  int64_t time_ns = 0;
  PoseStatus status = PoseStatus::absent;  // angles are this frame's only when ok; otherwise the last known ones
  int u_num = 3;
  int l_num = 15;
  Vec2 centre;  // pixels of the frame handed to core
  float dir_rad = 0;
  float head_angle = 0, tail_angle = 0;
  float l_fin_angle = 0, r_fin_angle = 0;
  float up_axis_angle[kMaxUpAxis] = {};
  float low_axis_angle[kMaxLowAxis] = {};
  PoseConfidence confidence;
};

// Where a fin that is not seen lies: back along the body, a little outwards.
inline constexpr float kFoldedLeftFin = -1.5707963f - 0.3f;
inline constexpr float kFoldedRightFin = -1.5707963f + 0.3f;

// Algorithm 2 for one frame; `last` (null for the first frame) gives continuity. pose.ok() must hold.
Motion motion_from_pose(const FishPose& pose, int64_t time_ns, const Motion* last);

}  // namespace nt
