// SPDX-License-Identifier: Apache-2.0
// The pose of one fish in one frame: every motion attribute of [F] Table 1.
//
// Points are in pixels of the frame handed to core (x right, y down, pixel centres at integers). `dir` is a unit vector
// towards the head. A point whose confidence is 0 was not seen and its coordinates mean nothing.
#pragma once
#include <cstdint>

#include "core/base/pose_status.h"
#include "core/base/vec2.h"

namespace nt {

inline constexpr int kMaxUpAxis = 8;    // room for u_num; [F] section 7 uses 3
inline constexpr int kMaxLowAxis = 32;  // room for l_num; [F] uses 15, and 25 for its flower

const char* to_string(PoseStatus status);

// Confidences in [0, 1], one per landmark group; 0 = not seen.
struct PoseConfidence {
  float centre = 0, head = 0, tail = 0, l_fin = 0, r_fin = 0, axis = 0;
};

struct FishPose {
  PoseStatus status = PoseStatus::absent;
  int u_num = 3;
  int l_num = 15;
  Vec2 centre;  // the point of the medial axis nearest to the barycentre
  Vec2 dir;     // unit, towards the head
  Vec2 head, tail;
  Vec2 l_fin, r_fin;                    // pectoral fin tips; left and right as the fish has them, seen from above
  Vec2 jun_tl, jun_tr, jun_bl, jun_br;  // fin-body junctions: top (head side) and bottom, left and right
  Vec2 up_axis[kMaxUpAxis];             // [0] next to centre .. [u_num-1] next to head
  Vec2 low_axis[kMaxLowAxis];           // [0] next to centre .. [l_num-1] next to tail
  float axis_len = 0;                   // length of the medial axis head to tail, pixels
  PoseConfidence confidence;

  bool ok() const { return status == PoseStatus::ok; }
};

}  // namespace nt
