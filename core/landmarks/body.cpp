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

bool find_tips(std::span<const Vec2> contour, std::span<const float> arc, Ends& tips) {
  constexpr float kWindow = 0.05f;    // of the perimeter, to either side: a tenth of the fish's length
  constexpr float kSharpest = 0.35f;  // of 1: the outline turns back on itself
  constexpr float kUneven = 4.0f;     // an open fin makes one flank longer by a few per cent of the perimeter
  constexpr int kMost = 24;
  const int n = static_cast<int>(contour.size());
  const float window = kWindow * arc[static_cast<std::size_t>(n)], apart = 0.6f * kWindow;
  struct Tip {
    int index;
    float sharp;
  } found[kMost];
  int count = 0, ahead = 0, behind = -n;
  const auto at = [&](int i) { return contour[static_cast<std::size_t>((i + 2 * n) % n)]; };
  const auto walked = [&](int i) {  // arc length of a point counted on beyond either end of the contour
    const int turns = i < 0 ? -1 : (i >= n ? 1 : 0);
    return arc[static_cast<std::size_t>(i - turns * n)] + static_cast<float>(turns) * arc[static_cast<std::size_t>(n)];
  };
  for (int i = 0; i < n; ++i) {
    while (ahead < 2 * n - 1 && walked(ahead) < walked(i) + window) ++ahead;
    while (behind < i && walked(behind + 1) <= walked(i) - window) ++behind;
    const Vec2 from = at(i) - at(behind), to = at(ahead) - at(i);
    const float sharp = cross(from, to) > 0 ? 1.0f - length(from + to) / (2.0f * window) : 0.0f;
    if (sharp < kSharpest) continue;
    // Of neighbours only the sharpest stays.
    Tip* const last = count > 0 ? &found[count - 1] : nullptr;
    if (last != nullptr && gap(arc, i, last->index) < apart) {
      if (sharp > last->sharp) *last = {i, sharp};
    } else if (count < kMost) {
      found[count++] = {i, sharp};
    }
  }
  float best = 0;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      const float uneven = 0.5f - gap(arc, found[a].index, found[b].index);
      const float score = found[a].sharp + found[b].sharp - kUneven * uneven;
      if (uneven < 0.15f && score > best) best = score, tips = {found[a].index, found[b].index};
    }
  }
  return best > 0;
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

float contrast_evidence(const Axis& axis, LumaView luma, LumaView ground) {
  if (luma.data == nullptr || ground.data == nullptr) return 0;
  float front = 0, back = 0;
  constexpr int kThird = kStations / 3;
  const auto difference = [&](int j) {
    const Vec2 p = axis.points[static_cast<std::size_t>(j)];
    const int x = clamp_int(static_cast<int>(p.x + 0.5f), 0, luma.width - 1);
    const int y = clamp_int(static_cast<int>(p.y + 0.5f), 0, luma.height - 1);
    const int d = luma.row(y)[x] - ground.row(y)[x];
    return static_cast<float>(d < 0 ? -d : d);
  };
  for (int j = 2; j < kThird; ++j) front += difference(j), back += difference(kStations - 1 - j);
  return det::clamp(2.0f * det::log((front + 20.0f) / (back + 20.0f)), -1.0f, 1.0f);
}

float continuity(const Axis& axis, std::span<const Vec2> last) {
  // A pose that continues moves by little and, turned round, by some half of its length: then nothing is left to doubt. A
  // ring moves by little either way.
  constexpr float kSurest = 9.2f;  // a mistake in 10,000 frames
  const int n = static_cast<int>(last.size());
  float same = 0, turned = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 p = axis.points[static_cast<std::size_t>(i * (kStations - 1) / (n - 1))];
    same += length(p - last[static_cast<std::size_t>(i)]);
    turned += length(p - last[static_cast<std::size_t>(n - 1 - i)]);
  }
  const float apart = (turned - same) / det::max(turned + same, 1e-6f);
  return kSurest * det::clamp(2.0f * apart, -1.0f, 1.0f);
}

float agreed(float a, float b) {
  // Surer than e^20 is not sure of more, and its exponential stays a number.
  a = det::clamp(a, -20.0f, 20.0f), b = det::clamp(b, -20.0f, 20.0f);
  const float low = det::min(a, b), gap = det::abs(a - b);
  // log((1 + e^(a+b)) / (e^a + e^b)), with the larger of the two taken out of the denominator.
  return det::log(1.0f + det::exp(a + b)) - (low + gap + det::log(1.0f + det::exp(-gap)));
}

}  // namespace nt
