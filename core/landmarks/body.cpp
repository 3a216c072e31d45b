// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/body.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

float gap(std::span<const float> arc, int a, int b) {  // along the contour, the short way, as a share of the perimeter
  const float perimeter = arc[arc.size() - 1];
  const float d = det::abs(arc[static_cast<std::size_t>(a)] - arc[static_cast<std::size_t>(b)]) / perimeter;
  return det::min(d, 1.0f - d);
}

float distance_sq(std::span<const Vec2> contour, int i, Vec2 from) {
  return length_sq(contour[static_cast<std::size_t>(i)] - from);
}

}  // namespace

Ends find_ends(std::span<const Vec2> contour, std::span<const float> arc, Vec2 barycentre) {
  const int n = static_cast<int>(contour.size());
  Ends ends;
  float farthest = -1;
  for (int i = 0; i < n; ++i) {
    const float d = distance_sq(contour, i, barycentre);
    if (d > farthest) farthest = d, ends.tail = i;
  }
  farthest = -1;
  for (int i = 0; i < n; ++i) {
    if (gap(arc, i, ends.tail) < 0.25f) continue;
    const float d = distance_sq(contour, i, barycentre);
    if (d > farthest) farthest = d, ends.head = i;
  }
  return ends;
}

int notch_of_tail(std::span<const Vec2> contour, std::span<const float> arc, Vec2 barycentre, int tail) {
  constexpr float kReach = 0.15f;  // of the perimeter: the width of a spread caudal fin, measured along its edge
  constexpr float kDip = 0.985f;   // the notch must lie this much nearer to the barycentre than the lesser tip
  constexpr float kAsFar = 0.85f;  // both tips of a caudal fin are about as far away
  const int n = static_cast<int>(contour.size());
  const float farthest = distance_sq(contour, tail, barycentre);
  int best_notch = tail;
  float best_tip = 0;
  for (int step : {1, -1}) {
    // Walk away from the tip: remember the nearest point so far; a rise after it is the second tip.
    int nearest = tail;
    float nearest_d = distance_sq(contour, tail, barycentre);
    for (int k = 1; k < n; ++k) {
      const int i = ((tail + step * k) % n + n) % n;
      if (gap(arc, i, tail) > kReach) break;
      const float d = distance_sq(contour, i, barycentre);
      if (d < nearest_d) nearest_d = d, nearest = i;
      // The corner of a dorsal or anal fin is a second tip too, but lies much nearer.
      if (d < kAsFar * kAsFar * farthest) continue;
      if (d * kDip * kDip > nearest_d && d > best_tip) best_tip = d, best_notch = nearest;
    }
  }
  return best_notch;
}

float order_evidence(std::span<const Vec2> smooth, const Axis& axis, Vec2 travel) {
  float front = 0, back = 0;
  constexpr int kThird = kStations / 3;
  const auto width = [&](int j) {
    return length(smooth[static_cast<std::size_t>(j)] - smooth[static_cast<std::size_t>(2 * kStations - 1 - j)]);
  };
  for (int j = 1; j < kThird; ++j) front += width(j), back += width(kStations - 1 - j);
  const float wider = det::clamp(3.0f * det::log(det::max(front, 0.1f) / det::max(back, 0.1f)), -2.0f, 2.0f);
  // Swimming backwards is rare and slow: a twentieth of a length in the direction of the head says as much as the shape.
  const Vec2 forward = normalised(axis.points[0] - axis.points[kStations - 1]);
  const float ahead = dot(travel, forward) / det::max(axis.length, 1.0f);
  return wider + det::clamp(20.0f * ahead, -1.5f, 1.5f);
}

float carried_belief(float log_odds) {
  // p' = p (1 - e) + (1 - p) e with e = 1e-4 (a real swap between two frames of a tracked fish), in log odds; the sum
  // is held within +-8, which e implies anyway.
  constexpr float kFlip = 1e-4f;
  const float p = 1.0f / (1.0f + det::exp(-det::clamp(log_odds, -20.0f, 20.0f)));
  const float q = p * (1 - kFlip) + (1 - p) * kFlip;
  return det::log(q / (1 - q));
}

}  // namespace nt
