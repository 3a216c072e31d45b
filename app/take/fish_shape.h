// SPDX-License-Identifier: Apache-2.0
// The filmed fish's own bones, and where they are in a motion: so that an edited motion has points again.
//
// Frames of a take -> median length of each bone and place of each fin, pixels of the working frame; with them
// motion -> pose. What the capture saw comes back to within the scatter of its bone lengths.
// Source: [F] Algorithm 3, on the fish instead of a character. Cost: O(bones) a frame.
#pragma once
#include <span>

#include "app/take/take.h"

namespace nt {

struct FishShape {
  int u_num = 3, l_num = 15;
  float head_len = 0, tail_len = 0;  // outermost bones
  float up_len[kMaxUpAxis] = {}, low_len[kMaxLowAxis] = {};
  float l_fin_len = 0, r_fin_len = 0;     // from the front junction to the tip; 0: never seen
  Vec2 l_front, l_back, r_front, r_back;  // junctions from the centre: x to the fish's right, y ahead
  float axis_len() const;
};

FishShape fish_shape(std::span<const TakeFrame> frames);
FishPose pose_of(const Motion& motion, const FishShape& shape);

}  // namespace nt
