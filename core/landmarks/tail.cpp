// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/tail.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr float kStep_px = 2.0f;
constexpr float kBeside_px = 3.0f;  // the ground is looked at here, to either side
// Stations that show what the tail looks like.
constexpr int kFrom = kStations * 2 / 3, kTo = kStations * 9 / 10;
constexpr float kThin = 0.6f;     // of its difference: less, and what lies beside it is the tail too
constexpr float kFaint = 0.3f;    // of its contrast: less is no tail
constexpr float kNoise = 1.0f;    // of the noise: the same
constexpr float kStrong = 1.5f;   // times its contrast: more counts no more
constexpr float kStart = 0.6f;    // of the axis, which is trusted up to here
constexpr float kLatest = 0.85f;  // of the axis
constexpr float kLongest = 1.2f;  // of the usual length
constexpr float kTurn = 0.2f;     // radians, between the turns that are tried
constexpr int kTurns = 2;         // to either side
// In contrasts: what a turn costs, times its square, and another length than the usual one, at most.
constexpr float kStiffness = 0.08f, kOdd = 50.0f, kOddest = 2.0f;
constexpr int kBeam = 8;
constexpr int kMostSteps = 96;
// Ways that have come as near to each other as this are one.
constexpr float kSame_px = 0.7f, kSameWay = 0.9f;

// (luma - ground) or its negative, such that the tail's is positive; between pixels too.
struct Difference {
  LumaView luma, ground;
  float sign = 1;

  float operator()(Vec2 p) const {
    const float x = det::clamp(p.x, 0.0f, static_cast<float>(luma.width - 2));
    const float y = det::clamp(p.y, 0.0f, static_cast<float>(luma.height - 2));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    const auto at = [&](int i, int j) { return static_cast<float>(luma.row(j)[i] - ground.row(j)[i]); };
    const float above = at(x0, y0) + (at(x0 + 1, y0) - at(x0, y0)) * u;
    const float below = at(x0, y0 + 1) + (at(x0 + 1, y0 + 1) - at(x0, y0 + 1)) * u;
    return sign * (above + (below - above) * v);
  }

  // How much `p` on a line along `dir` differs from what lies beside the line.
  float contrast(Vec2 p, Vec2 dir) const {
    const Vec2 across = right_of(dir) * kBeside_px;
    return (*this)(p)-0.5f * ((*this)(p + across) + (*this)(p - across));
  }

  bool holds(Vec2 p) const {
    return p.x >= 1 && p.y >= 1 && p.x <= static_cast<float>(luma.width - 2) &&
           p.y <= static_cast<float>(luma.height - 2);
  }
};

// What the tail looks like before its end.
struct Look {
  float contrast = 0;  // its sign is the tail's
  float noise = 0;     // of the contrast where no tail is, standard deviation
  bool thin = false;
};

Look look_of(const Axis& axis, const Difference& difference, int from) {
  float contrast = 0, inside = 0, squares = 0;
  for (int j = from; j < kTo; ++j) {
    const Vec2 p = axis.points[static_cast<std::size_t>(j)];
    const Vec2 dir = normalised(axis.points[static_cast<std::size_t>(j) + 1] - p),
               away = right_of(dir) * (2 * kBeside_px);
    inside += difference(p);
    contrast += difference.contrast(p, dir);
    const float l = difference.contrast(p - away, dir), r = difference.contrast(p + away, dir);
    squares += l * l + r * r;
  }
  const float count = static_cast<float>(kTo - from);
  return {contrast / count, det::sqrt(squares / (2 * count)), det::abs(contrast) >= kThin * det::abs(inside)};
}

struct Node {
  Vec2 p, dir;
  float score = 0;
  int parent = 0;  // of the step before
};

// The ways that are being tried.
struct Search {
  const Difference& difference;
  float contrast, enough;  // of the tail; of a step that is worth it
  det::SinCos turns[2 * kTurns + 1];
  Node nodes[kMostSteps + 1][kBeam];
  int counts[kMostSteps + 1];

  Search(const Difference& d, const Look& look, Vec2 start, Vec2 dir)
      : difference(d), contrast(d.sign * look.contrast), enough(det::max(kFaint * contrast, kNoise * look.noise)) {
    for (int k = -kTurns; k <= kTurns; ++k) turns[k + kTurns] = det::sincos(kTurn * static_cast<float>(k));
    nodes[0][0] = {start, dir, 0, 0};
    counts[0] = 1;
  }

  void offer(int step, const Node& node) {
    Node* there = nodes[step];
    int& count = counts[step];
    int place = count;
    for (int i = 0; i < count && place == count; ++i) {
      const Node& other = there[i];
      if (length_sq(other.p - node.p) < kSame_px * kSame_px && dot(other.dir, node.dir) > kSameWay) place = i;
    }
    if (place == kBeam) {
      place = 0;
      for (int i = 1; i < kBeam; ++i)
        if (there[i].score < there[place].score) place = i;
    }
    if (place == count) ++count;
    else if (there[place].score >= node.score) return;
    there[place] = node;
  }

  void go_on(int step) {
    counts[step + 1] = 0;
    for (int i = 0; i < counts[step]; ++i) {
      const Node& from = nodes[step][i];
      if (!difference.holds(from.p)) continue;
      for (int k = -kTurns; k <= kTurns; ++k) {
        const det::SinCos a = turns[k + kTurns];
        const Vec2 dir{from.dir.x * a.cos - from.dir.y * a.sin, from.dir.x * a.sin + from.dir.y * a.cos};
        const Vec2 half = dir * (0.5f * kStep_px), to = from.p + dir * kStep_px;
        const float seen = 0.5f * (difference.contrast(from.p + half, dir) + difference.contrast(to, dir)) - enough;
        const float worth =
            det::min(seen, kStrong * contrast - enough) - kStiffness * contrast * static_cast<float>(k * k);
        offer(step + 1, {to, dir, from.score + worth, i});
      }
    }
  }

  // Where the tail ends on the way's last step or just beyond it.
  Vec2 end_of(const Node& from, Vec2 dir) const {
    constexpr int kParts = 4;
    float sum = 0, best = 0;
    int reach = 1;
    for (int i = 1; i <= 2 * kParts; ++i) {
      sum += difference.contrast(from.p + dir * (kStep_px / kParts * static_cast<float>(i)), dir) - enough;
      if (sum > best) best = sum, reach = i;
    }
    return from.p + dir * (kStep_px / kParts * static_cast<float>(reach));
  }
};

}  // namespace

Axis followed_tail(const Axis& axis, LumaView luma, LumaView ground, float usual_length) {
  if (luma.data == nullptr || ground.data == nullptr || luma.width < 2 || luma.height < 2) return axis;
  const float longest = kLongest * det::max(usual_length, axis.length);
  const float share = det::max(kStart, (longest - kMostSteps * kStep_px) / axis.length);
  if (share > kLatest) return axis;
  const int start = static_cast<int>(share * (kStations - 1));
  Difference difference{luma, ground};
  const Look look = look_of(axis, difference, max_int(start, kFrom));
  if (!look.thin) return axis;
  if (look.contrast < 0) difference.sign = -1;

  const auto at = [&](int j) { return axis.points[static_cast<std::size_t>(j)]; };
  const float before = axis.length * static_cast<float>(start) / (kStations - 1);
  const int steps = min_int(static_cast<int>((longest - before) / kStep_px), kMostSteps);
  Search search(difference, look, at(start), normalised(at(start + 2) - at(start - 2)));
  float best = -1e30f;
  int length = 0, last = 0;
  for (int step = 1; step <= steps; ++step) {
    search.go_on(step - 1);
    const float off = usual_length > 0 ? (before + kStep_px * static_cast<float>(step)) / usual_length - 1 : 0;
    const float odd = search.contrast * det::min(kOdd * off * off, kOddest);
    for (int i = 0; i < search.counts[step]; ++i) {
      const float score = search.nodes[step][i].score - odd;
      if (score > best) best = score, length = step, last = i;
    }
  }
  if (length == 0 || search.nodes[length][last].score <= 0) return axis;
  Vec2 line[kStations + kMostSteps];
  const int count = start + 1 + length;
  for (int j = 0; j <= start; ++j) line[j] = at(j);
  const Node& end = search.nodes[length][last];
  line[start + length] = search.end_of(search.nodes[length - 1][end.parent], end.dir);
  for (int step = length - 1, i = end.parent; step > 0; i = search.nodes[step--][i].parent)
    line[start + step] = search.nodes[step][i].p;
  return resampled({line, static_cast<std::size_t>(count)});
}

}  // namespace nt
