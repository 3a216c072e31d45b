// SPDX-License-Identifier: Apache-2.0
// Closed contour -> every landmark of [F] Table 1. The same code for a filmed fish and for a drawing.
//
// Input: the ordered outer border of one fish (either sense, at least 16 points, pixels, y down).
// Output: a FishPose in the same frame. Cost: O(contour points x harmonics), about 0.05 ms for 1,000 points.
// Source: [F] sections 4.1-4.4, Eqs 1-6; differences are stated at each step's own file.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/limits.h"
#include "core/landmarks/fish_pose.h"

namespace nt {

struct LandmarkSettings {
  int u_num = 3;
  int l_num = 15;
  int harmonics = 5;  // S
};

// What is known from elsewhere about which end is the head. All optional.
struct LandmarkHints {
  bool has_last = false;  // the ends of the last frame's fish, moved to where they should be now
  Vec2 last_head, last_tail;
  float head_log_odds = 0;  // belief so far that last_head really is the head (natural log of odds)
  Vec2 travel;              // displacement of the centre over the last frames, pixels; 0 when at rest
};

class Landmarks {
 public:
  static Landmarks* create(Arena& arena, const Limits& limits,
                           const LandmarkSettings& settings);  // null when measuring

  // False when the outline is no fish (too short, no area, self-touching); pose.status tells nothing then.
  bool find(std::span<const Vec2> contour, const LandmarkHints& hints, FishPose& pose);

  float head_log_odds() const;                   // belief after the last find
  float area_px() const;                         // inside the outline of the last find
  bool swapped() const;                          // the last find reversed the order that the hints had
  std::span<const Vec2> smooth_contour() const;  // elliptic Fourier reconstruction of the last find
  std::span<const Vec2> midline() const;         // dense medial axis of the last find, head to tail
};

}  // namespace nt
