// SPDX-License-Identifier: Apache-2.0
// Edits of a whole stretch of motion: smooth, exaggerate, repair, loop, retime. Frames first..last, both inside.
//
// Where a stretch begins or ends inside the sequence the change fades in and out over kFadeFrames, so no step appears.
// Angles must be continuous from frame to frame. Cost: O(frames) each.
#pragma once
#include <cstddef>
#include <vector>

#include "app/take/edits.h"

namespace nt {

inline constexpr int kFadeFrames = 8;

// Whittaker's smoother in time (Eilers 2003, second differences): what is shorter than about `frames` frames goes.
void smooth(std::vector<Motion>& m, MotionProperty u, std::size_t first, std::size_t last, double frames);
// factor times as far from the rest pose.
void exaggerate(std::vector<Motion>& m, MotionProperty u, float rest, std::size_t first, std::size_t last,
                float factor);
// Frames without a pose, or whose head, tail or axis is less sure than `confidence`, come to lie between their good
// neighbours; at an end they take the nearest one's place. They then count as good.
void repair(std::vector<Motion>& m, std::size_t first, std::size_t last, float confidence);
// Cuts out first..last and closes it: the last `blend` frames bend towards the first one, and the way that the fish has
// swum is taken back evenly, so it swims on the spot.
Seam make_loop(std::vector<Motion>& m, std::size_t first, std::size_t last, std::size_t blend);
// `speed` times as fast, with the same time between frames.
void retime(std::vector<Motion>& m, double speed);

}  // namespace nt
