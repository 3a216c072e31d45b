// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/tail.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr float kStep_px = 1.5f;
constexpr float kSight_px = 6.0f;   // over which a segment is averaged
constexpr float kBeside_px = 4.0f;  // the ground is looked at here, to either side
constexpr float kFaint = 0.35f;     // of the tail's own contrast
constexpr float kThin = 0.6f;       // of its difference: less, and what lies beside it is the tail too
constexpr float kLeast = 4.0f;      // grey levels
constexpr float kMostOn = 0.3f;     // of the axis
constexpr float kTurn = 0.2f;       // radians, between segments that are tried
constexpr int kTurns = 3;           // to either side
constexpr int kMostSteps = 64;

// luma - ground, between pixels too.
float difference(LumaView luma, LumaView ground, Vec2 p) {
  const float x = det::clamp(p.x, 0.0f, static_cast<float>(luma.width - 2));
  const float y = det::clamp(p.y, 0.0f, static_cast<float>(luma.height - 2));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
  const auto at = [&](int i, int j) { return static_cast<float>(luma.row(j)[i] - ground.row(j)[i]); };
  const float above = at(x0, y0) + (at(x0 + 1, y0) - at(x0, y0)) * u;
  const float below = at(x0, y0 + 1) + (at(x0 + 1, y0 + 1) - at(x0, y0 + 1)) * u;
  return above + (below - above) * v;
}

// How much a segment from `p` along `dir` differs from what lies beside it.
float stands_out(LumaView luma, LumaView ground, Vec2 p, Vec2 dir) {
  constexpr int kSamples = 6;
  float sum = 0;
  for (int i = 1; i <= kSamples; ++i) {
    const Vec2 at = p + dir * (kSight_px * static_cast<float>(i) / kSamples), across = right_of(dir) * kBeside_px;
    sum += difference(luma, ground, at) -
           0.5f * (difference(luma, ground, at + across) + difference(luma, ground, at - across));
  }
  return sum / kSamples;
}

Vec2 turned(Vec2 dir, float angle) {
  const det::SinCos a = det::sincos(angle);
  return {dir.x * a.cos - dir.y * a.sin, dir.x * a.sin + dir.y * a.cos};
}

}  // namespace

Axis followed_tail(const Axis& axis, LumaView luma, LumaView ground) {
  if (luma.data == nullptr || ground.data == nullptr || luma.width < 2 || luma.height < 2) return axis;
  // What the tail looks like before its end, and with which sign.
  float contrast = 0, inside = 0;
  constexpr int kFrom = kStations * 3 / 4, kTo = kStations - 7;
  for (int j = kFrom; j < kTo; j += 3) {
    const Vec2 p = axis.points[static_cast<std::size_t>(j)];
    inside += difference(luma, ground, p);
    contrast += stands_out(luma, ground, p, normalised(axis.points[static_cast<std::size_t>(j) + 1] - p));
  }
  if (det::abs(contrast) < kThin * det::abs(inside)) return axis;
  contrast /= static_cast<float>((kTo - kFrom + 2) / 3);
  const float sign = contrast < 0 ? -1.0f : 1.0f, enough = det::max(kFaint * sign * contrast, kLeast);

  Vec2 line[kStations + kMostSteps];
  std::size_t count = 0;
  for (const Vec2 p : axis.points) line[count++] = p;
  Vec2 dir = normalised(axis.points[kStations - 1] - axis.points[kStations - 5]);
  const int steps = min_int(static_cast<int>(kMostOn * axis.length / kStep_px), kMostSteps);
  for (int i = 0; i < steps; ++i) {
    const Vec2 p = line[count - 1];
    if (p.x < 1 || p.y < 1 || p.x > static_cast<float>(luma.width - 2) || p.y > static_cast<float>(luma.height - 2))
      break;
    float best = 0;
    Vec2 way = dir;
    for (int k = -kTurns; k <= kTurns; ++k) {
      const Vec2 tried = turned(dir, kTurn * static_cast<float>(k));
      const float seen = sign * stands_out(luma, ground, p, tried);
      if (seen > best) best = seen, way = tried;
    }
    if (best < enough) break;
    dir = way;
    line[count++] = p + dir * kStep_px;
  }
  return count == kStations ? axis : resampled({line, count});
}

}  // namespace nt
