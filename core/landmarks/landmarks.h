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
#include "core/base/image_view.h"
#include "core/base/limits.h"
#include "core/landmarks/fish_pose.h"
#include "core/landmarks/order_step.h"

namespace nt {

struct LandmarkSettings {
  int u_num = 3;
  int l_num = 15;
  int harmonics = 5;  // S
};

// What is known from elsewhere about which end is the head. All optional.
struct LandmarkHints {
  // The last frame's axis, moved to where it should be now: points evenly spaced from its head to its tail, at least these
  // two. Empty when there is none.
  std::span<const Vec2> last;
  float head_log_odds = 0;  // belief so far that last.front() really is the head (natural log of odds)
  float trust = 1;          // 0..1, in `last`: less after a gap
  Vec2 travel;              // displacement of the centre over the last frames, pixels; 0 when at rest
  float usual_length = 0;   // of the axis, pixels; 0 when unknown
  LumaView luma, ground;    // the picture and what it would be without the fish; without data when unknown
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
  OrderStep order() const;                       // of the last find
  std::span<const Vec2> smooth_contour() const;  // elliptic Fourier reconstruction of the last find
  std::span<const Vec2> midline() const;         // dense medial axis of the last find, head to tail
};

}  // namespace nt
