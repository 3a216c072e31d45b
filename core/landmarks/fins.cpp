// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/fins.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr float kFrom = 0.15f, kTo = 0.60f;  // where pectoral fins can be, as shares of the length behind the head
constexpr float kSnout = 0.05f, kPeduncle = 0.8f;
constexpr float kStandsOut = 0.0275f;  // of the length, above the body: less is outline noise or a folded fin
constexpr float kPlainlyOut = 0.064f;

// One side of the outline as a sequence from head to tail.
struct SideWalk {
  int begin, count, step, n;
  int at(int k) const { return ((begin + step * k) % n + n) % n; }
};

// Depth of `p` below the line from q to r, positive on the side of the fish's axis.
float depth_below(Vec2 q, Vec2 r, Vec2 p, float inward) { return inward * cross(normalised(r - q), p - q); }

constexpr float kHeadEnd = 0.13f, kBeyondHead = 1.1f;
constexpr float kHeadRound = 0.08f;  // of the length: before it every head gets narrower
constexpr float kBreadth = 0.02f;    // of the length, half-way up
constexpr float kTipRound = 0.06f;   // of the length: as near to the tip the outline turns round it

// The junction between the tip (position k_tip of the walk) and P at position k_end (0: head, last: tail).
int find_junction(std::span<const Vec2> contour, const SideWalk& walk, int k_tip, int k_end, float inward,
                  float tip_round) {
  const auto point = [&](int k) { return contour[static_cast<std::size_t>(walk.at(k))]; };
  const int step = k_end > k_tip ? 1 : -1;
  const Vec2 q = point(k_tip), to_p = normalised(point(k_end) - q);
  const float sign = step > 0 ? inward : -inward;
  // The angle PQR is largest where its cosine is smallest. Points on the round of the tip give no direction.
  int k_r = k_end;
  float smallest = 2;
  for (int k = k_tip + step; (k_end - k) * step > 0; k += step) {
    const Vec2 to_r = point(k) - q;
    if (length_sq(to_r) < tip_round * tip_round) continue;
    const float c = dot(to_p, normalised(to_r));
    if (c < smallest) smallest = c, k_r = k;
  }
  // [F]: the point of QR farthest from the line QR, on its inner side. Where the fin's edge is straight that is noise, and
  // R itself is the corner between fin and body.
  int best = k_r;
  float deepest = 0.25f * tip_round;
  for (int k = k_tip; (k_r - k) * step >= 0; k += step) {
    const float depth = depth_below(q, point(k_r), point(k), sign);
    if (depth > deepest) deepest = depth, best = k;
  }
  // Along a straight edge all angles are the same, along a hollow one the largest is beside the tip, and a bulging one has
  // its largest on the other side of PQ: then the corner is where the outline lies deepest below PQ.
  int corner = k_tip;
  deepest = 0;
  for (int k = k_tip; (k_end - k) * step >= 0; k += step) {
    const float depth = depth_below(q, point(k_end), point(k), sign);
    if (depth > deepest) deepest = depth, corner = k;
  }
  const bool short_of_it = (corner - best) * step > 0 && length(point(corner) - point(best)) > tip_round;
  return short_of_it ? corner : best;
}

}  // namespace

Fin find_fin(std::span<const Vec2> contour, std::span<const AlongAxis> along, Stretch right, const StationValues& body,
             float axis_length, Side side) {
  const int n = static_cast<int>(contour.size());
  const bool is_right = side == Side::right;
  const SideWalk walk{right.begin, is_right ? right.count : n - right.count, is_right ? 1 : -1, n};
  const auto place = [&](int k) {
    const AlongAxis a = along[static_cast<std::size_t>(walk.at(k))];
    return AlongAxis{a.s, is_right ? a.d : -a.d};
  };
  Fin fin;
  int k_tip = -1;
  float farthest = 0;
  for (int k = 1; k < walk.count; ++k) {
    const AlongAxis a = place(k);
    if (a.s >= kFrom && a.s <= kTo && a.d > farthest) farthest = a.d, k_tip = k;
  }
  if (k_tip < 0) return fin;
  // P stands for head and tail, but no root of a pectoral fin lies in the snout or in the caudal fin.
  int k_head = k_tip, k_tail = k_tip;
  while (k_head > 0 && place(k_head).s > kSnout) --k_head;
  while (k_tail < walk.count && place(k_tail).s < kPeduncle) ++k_tail;
  // Walking head -> tail, the axis lies to the right hand on the left side and to the left hand on the right side;
  // cross() is positive clockwise, so inward is +1 on the right side.
  const float inward = is_right ? 1.0f : -1.0f;
  const float tip_round = kTipRound * axis_length;
  const int top = find_junction(contour, walk, k_tip, k_head, inward, tip_round);
  const int bottom = find_junction(contour, walk, k_tip, k_tail, inward, tip_round);
  fin.tip = walk.at(k_tip), fin.top = walk.at(top), fin.bottom = walk.at(bottom);
  const int station = static_cast<int>(place(k_tip).s * (kStations - 1) + 0.5f);
  const float flank = body[static_cast<std::size_t>(station)];
  const float stands_out = (farthest - flank) / axis_length;
  // How broad it is half-way up: a spur of outline noise is a pixel or two.
  int k_up = k_tip, k_down = k_tip;
  while (k_up > 0 && place(k_up).d > 0.5f * (flank + farthest)) --k_up;
  while (k_down < walk.count && place(k_down).d > 0.5f * (flank + farthest)) ++k_down;
  const auto point = [&](int k) { return contour[static_cast<std::size_t>(walk.at(k))]; };
  const float breadth = length(point(k_up) - point(k_down)) / axis_length;
  // Ahead of a fin there is flank again; a broad head (a larva's) only gets broader.
  float flank_ahead = farthest;
  for (int k = k_tip; k > 0 && place(k).s > kHeadRound; --k) flank_ahead = det::min(flank_ahead, place(k).d);
  const bool apart = flank_ahead < 0.5f * (flank + farthest);
  // Nothing that reaches no farther than the head is a fin: a larva's eyes are its widest part, its swim bladder the next.
  float head_reach = 0;
  for (int k = 1; k < k_tip && place(k).s < kHeadEnd; ++k) head_reach = det::max(head_reach, place(k).d);
  const bool out = stands_out > kStandsOut && farthest > kBeyondHead * head_reach;
  fin.seen = out && breadth > kBreadth && apart && top < k_tip && bottom > k_tip;
  if (fin.seen) fin.confidence = det::clamp(stands_out / kPlainlyOut, 0.0f, 1.0f);
  return fin;
}

}  // namespace nt
