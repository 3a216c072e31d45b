// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/mocap/marker_file.h"
#include "core/deform/rotations.h"
#include "platform/camera.h"

namespace nt {
namespace {

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 p : points) sum += p;
  return sum * (1.0f / static_cast<float>(points.size()));
}

// The box around the points.
struct Bounds {
  Vec3 low, high;
  Vec3 centre() const { return 0.5f * (low + high); }
  float diagonal() const { return length(high - low); }
};
Bounds bounds(const std::vector<Vec3>& points) {
  Bounds b{points[0], points[0]};
  for (const Vec3 p : points) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
  }
  return b;
}

Vec3 nearest(Vec3 p, const std::vector<Vec3>& points) {
  Vec3 best;
  float least = std::numeric_limits<float>::infinity();
  for (const Vec3 q : points) {
    const float d = length_sq(p - q);
    if (d < least) least = d, best = q;
  }
  return best;
}

// Horn's rotation and Umeyama's scale that take a to b.
Registration fit(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const Vec3 ca = mean(a), cb = mean(b);
  float s[9] = {};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 p = a[i] - ca, q = b[i] - cb;
    const float from[3] = {p.x, p.y, p.z}, to[3] = {q.x, q.y, q.z};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) s[3 * r + c] += from[r] * to[c];
    }
  }
  Registration out;
  out.turn = best_rotation(s);
  float along = 0.0f, square = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) {
    along += dot(rotate(out.turn, a[i] - ca), b[i] - cb);
    square += length_sq(a[i] - ca);
  }
  out.scale = std::max(along / square, 1e-9f);
  out.shift = cb - rotate(out.turn, out.scale * ca);
  return out;
}

std::vector<Quat> axis_turns() {
  std::vector<Quat> out;
  const float r = std::sqrt(0.5f);
  const Quat quarter_z{r, 0, 0, r}, quarter_x{r, r, 0, 0}, quarter_y{r, 0, r, 0};
  const Quat to_face[6] = {{},
                           quarter_x,
                           quarter_x * quarter_x,
                           quarter_x * quarter_x * quarter_x,
                           quarter_y,
                           quarter_y * quarter_y * quarter_y};
  for (const Quat& face : to_face) {
    Quat q = face;
    for (int k = 0; k < 4; ++k) {
      out.push_back(q);
      q = quarter_z * q;
    }
  }
  return out;
}

}  // namespace

Quat parse_axes(const std::string& axes) {
  float s[9] = {};
  std::size_t at = 0, row = 0;
  for (; row < 3 && at < axes.size(); ++row) {
    const float sign = axes[at] == '-' ? -1.0f : 1.0f;
    if (axes[at] == '-' || axes[at] == '+') ++at;
    if (at >= axes.size() || axes[at] < 'x' || axes[at] > 'z') break;
    s[3 * static_cast<std::size_t>(axes[at] - 'x') + row] = sign;
    ++at;
    if (at < axes.size() && axes[at] == ',') ++at;
  }
  const float det =
      s[0] * (s[4] * s[8] - s[5] * s[7]) - s[1] * (s[3] * s[8] - s[5] * s[6]) + s[2] * (s[3] * s[7] - s[4] * s[6]);
  if (row != 3 || at != axes.size() || det != 1.0f) {
    throw UserError("--axes wants three axes that make a turn, such as x,z,-y", 2);
  }
  return best_rotation(s);
}

Registration register_to_places(std::span<const Vec3> markers, std::span<const Vec3> places) {
  std::vector<Vec3> from, to;
  for (std::size_t k = 0; k < markers.size(); ++k) {
    if (is_seen(markers[k])) from.push_back(markers[k]), to.push_back(places[k]);
  }
  if (from.size() < 3) {
    throw UserError("fewer than three markers are seen in the frame to register; choose another --frame");
  }
  Registration out = fit(from, to);
  float sum = 0.0f;
  for (std::size_t k = 0; k < from.size(); ++k) sum += length_sq(out(from[k]) - to[k]);
  out.rms = std::sqrt(sum / static_cast<float>(from.size()));
  return out;
}

Registration register_markers(std::span<const Vec3> markers, const std::vector<Vec3>& mesh,
                              std::span<const Quat> turns) {
  constexpr std::size_t kMost = 4000;  // mesh vertices that are looked at
  constexpr int kRounds = 40;
  std::vector<Vec3> from, to;
  for (const Vec3 p : markers) {
    if (is_seen(p)) from.push_back(p);
  }
  if (from.size() < 4)
    throw UserError("fewer than four markers are seen in the frame to register; choose another --frame");
  for (std::size_t i = 0; i < mesh.size(); i += mesh.size() / kMost + 1) to.push_back(mesh[i]);
  // Markers sit on the outside and reach nearly everywhere, so the boxes tell the scale; a mean would lean to where a mesh
  // has many vertices.
  const Bounds from_box = bounds(from), to_box = bounds(mesh);
  const float scale = to_box.diagonal() / std::max(from_box.diagonal(), 1e-9f);
  const std::vector<Quat> all = axis_turns();
  Registration best;
  best.rms = std::numeric_limits<float>::infinity();
  std::vector<Vec3> targets(from.size());
  for (const Quat& turn : turns.empty() ? std::span<const Quat>(all) : turns) {
    Registration now;
    now.turn = turn, now.scale = scale;
    now.shift = to_box.centre() - rotate(turn, scale * from_box.centre());
    for (int round = 0; round < kRounds; ++round) {
      float sum = 0.0f;
      for (std::size_t i = 0; i < from.size(); ++i) {
        targets[i] = nearest(now(from[i]), to);
        sum += length_sq(targets[i] - now(from[i]));
      }
      now.rms = std::sqrt(sum / static_cast<float>(from.size()));
      if (now.rms < best.rms) best = now;
      now = fit(from, targets);
      // Everything shrunk onto one vertex would be near, too.
      const float held = std::clamp(now.scale, 0.93f * scale, 1.1f * scale);
      now.shift = mean(targets) - rotate(now.turn, held * mean(from));
      now.scale = held;
    }
  }
  if (!std::isfinite(best.rms)) throw UserError("the markers do not fit the mesh; choose another --frame");
  return best;
}

}  // namespace nt
