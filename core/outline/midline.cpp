// SPDX-License-Identifier: Apache-2.0
#include "core/outline/midline.h"

#include "core/base/det_math.h"
#include "core/base/image_view.h"

namespace nt {
namespace {

constexpr int kLast = kStations - 1;
// A ray that leaves the outline farther than this from its end point (share of the length) left through a flank.
constexpr float kNearEnd = 0.06f, kNearHead = 0.12f;  // a blunt head's end point may be its corner
constexpr float kNearNotch = 0.02f;                   // of a forked tail: farther away lies a lobe
constexpr float kNotchAhead = 0.7f;                   // cosine: a notch lies within 45 degrees of where the tail points
constexpr int kFinsFrom = 7, kFinsTo = 42;            // stations where pectoral fins can stand
// Of the smoother: the axis may bend within about four stations; the body's width changes over ten or more.
constexpr float kAxisStiffness = 1.0f, kBodyStiffness = 60.0f;
// A mean half-width above kFinWidth body + kFinExcess length is a fin's.
constexpr float kFinWidth = 1.05f, kFinExcess = 0.004f;

float fraction_between(float from, float to) {
  const float d = to - from;
  return d < 0 ? d + 1.0f : d;
}

// The axis' segments, with what every foot of a perpendicular needs of them.
struct Segments {
  Vec2 a[kLast], ab[kLast];
  float inverse[kLast];  // 1 / |ab|^2

  explicit Segments(const Axis& axis) {
    for (std::size_t j = 0; j < kLast; ++j) {
      a[j] = axis.points[j];
      ab[j] = axis.points[j + 1] - a[j];
      inverse[j] = 1.0f / det::max(length_sq(ab[j]), 1e-12f);
    }
  }
};

// The foot of `p` on segment j: its place on the segment, and the squared distance.
struct Foot {
  float u = 0;
  float dist_sq = 1e30f;
};

Foot foot(const Segments& axis, int j, Vec2 p) {
  const Vec2 ap = p - axis.a[j];
  float u = dot(ap, axis.ab[j]) * axis.inverse[j];
  // The end segments go on beyond the axis, so that the caps get places outside [0, 1].
  if (j != 0 && u < 0) u = 0;
  if (j != kLast - 1 && u > 1) u = 1;
  return {u, length_sq(ap - axis.ab[j] * u)};
}

AlongAxis place_on(const Segments& axis, int j, Foot f, Vec2 p) {
  // ab points to the tail; the fish's right is then to the left of ab on the screen: cross(ab, offset) < 0.
  const bool is_right = cross(axis.ab[j], p - axis.a[j]) <= 0;
  const float d = det::sqrt(f.dist_sq);
  return {(static_cast<float>(j) + f.u) / kLast, is_right ? d : -d};
}

// Continues from `segment`: walks to the locally nearest one, looking past the kinks that a half-corrected axis has.
AlongAxis nearest_from(const Segments& axis, Vec2 p, int& segment) {
  constexpr int kLookOn = 5, kLookBack = 2;
  int best_j = segment;
  Foot best = foot(axis, segment, p);
  for (int j = segment + 1; j < kLast && j <= best_j + kLookOn; ++j) {
    const Foot f = foot(axis, j, p);
    if (f.dist_sq < best.dist_sq) best = f, best_j = j;
  }
  for (int j = segment - 1; j >= 0 && j >= best_j - kLookBack; --j) {
    const Foot f = foot(axis, j, p);
    if (f.dist_sq < best.dist_sq) best = f, best_j = j;
  }
  segment = best_j;
  return place_on(axis, best_j, best, p);
}

// Fills the stations that the segment between two projected points crosses, keeping the wider value.
void add_edge(std::array<float, kStations>& side, AlongAxis a, AlongAxis b, float sign) {
  if (a.s > b.s) {
    const AlongAxis t = a;
    a = b, b = t;
  }
  const int first = max_int(static_cast<int>(a.s * kLast) + (a.s * kLast > 0 ? 1 : 0), 0);
  for (int j = max_int(first - 1, 0); j <= kLast; ++j) {
    const float s = static_cast<float>(j) / kLast;
    if (s < a.s) continue;
    if (s > b.s) break;
    const float u = b.s > a.s ? (s - a.s) / (b.s - a.s) : 0.0f;
    side[static_cast<std::size_t>(j)] = det::max(side[static_cast<std::size_t>(j)], sign * (a.d + (b.d - a.d) * u));
  }
}

// Stations that no edge crossed take their neighbours' value.
void fill_gaps(std::array<float, kStations>& side) {
  float last = 0;
  for (float& v : side) {
    if (v < 0) v = last;
    last = v;
  }
}

// Place along the axis of any point, from all segments.
float place_of(const Segments& axis, Vec2 p) {
  Foot best;
  int best_j = 0;
  for (int j = 0; j < kLast; ++j) {
    const Foot f = foot(axis, j, p);
    if (f.dist_sq < best.dist_sq) best = f, best_j = j;
  }
  return det::clamp((static_cast<float>(best_j) + best.u) / kLast, 0.0f, 1.0f);
}

// Stations between which the axis can be trusted. It may run on past a notched tail or stop short of a thin one: the ends of
// the outline, not of the axis, say where it is still inside.
struct Reliable {
  int first, last;
};

// The last station up to `last` that has the notch ahead, within kNotchAhead of where the axis goes: one that strayed into a
// lobe has it abeam, and the axis drawn from there would hook.
int before_notch(const Axis& axis, Vec2 notch, int last) {
  for (int j = last; j > 3 * kLast / 4; --j) {
    const Vec2 p = axis.points[static_cast<std::size_t>(j)];
    const Vec2 forward = normalised(p - axis.points[static_cast<std::size_t>(j - 4)]);
    if (dot(normalised(notch - p), forward) >= kNotchAhead) return j;
  }
  return 3 * kLast / 4;
}

Reliable reliable_part(const Axis& axis, const AxisEnds& ends) {
  const Segments segments(axis);
  const int first =
      clamp_int(static_cast<int>((place_of(segments, ends.head) + ends.head_trim) * kLast) + 1, 1, kLast / 4);
  const int last =
      clamp_int(static_cast<int>((place_of(segments, ends.tail) - ends.tail_trim) * kLast), 3 * kLast / 4, kLast - 1);
  return {first, ends.notched ? before_notch(axis, ends.tail, last) : last};
}

Axis with_ends(const Axis& axis, Reliable part, Vec2 head, Vec2 tail) {
  Vec2 points[kStations + 2];
  int count = 0;
  points[count++] = head;
  for (int j = part.first; j <= part.last; ++j) points[count++] = axis.points[static_cast<std::size_t>(j)];
  points[count++] = tail;
  return resampled({points, static_cast<std::size_t>(count)});
}

// Distance from `p` along unit `dir` to the nearest crossing with the contour that lies within `reach`; -1 if none.
float ray_to_contour(std::span<const Vec2> contour, Vec2 p, Vec2 dir, float reach) {
  float best = -1;
  const std::size_t n = contour.size();
  float side_before = cross(dir, contour[n - 1] - p);
  for (std::size_t i = 0; i < n; ++i) {
    const float side = cross(dir, contour[i] - p);
    if ((side < 0) != (side_before < 0)) {
      const Vec2 a = contour[i == 0 ? n - 1 : i - 1], b = contour[i];
      const Vec2 hit = lerp(a, b, side_before / (side_before - side));
      const float along = dot(hit - p, dir);
      if (along >= 0 && along <= reach && (best < 0 || along < best)) best = along;
    }
    side_before = side;
  }
  return best;
}

}  // namespace

Axis medial_axis(const EllipticFourier& fourier, float t_head, float t_tail, std::span<Vec2> smooth) {
  Vec2 middle[kStations];
  const float right = fraction_between(t_head, t_tail), left = 1.0f - right;
  for (int i = 0; i < kStations; ++i) {
    const float u = static_cast<float>(i) / kLast;
    const Vec2 p = fourier.at(t_head + right * u), q = fourier.at(t_head - left * u);
    smooth[static_cast<std::size_t>(i)] = p;
    smooth[static_cast<std::size_t>(2 * kStations - 1 - i)] = q;
    middle[i] = lerp(p, q, 0.5f);  // Eq 1
  }
  return resampled(middle);
}

Axis resampled(std::span<const Vec2> polyline) {
  Axis axis;
  const std::size_t n = polyline.size();
  for (std::size_t i = 0; i + 1 < n; ++i) axis.length += length(polyline[i + 1] - polyline[i]);
  std::size_t segment = 0;
  float walked = 0, here = n > 1 ? length(polyline[1] - polyline[0]) : 0.0f;
  for (int j = 0; j < kStations; ++j) {
    const float want = axis.length * static_cast<float>(j) / kLast;
    while (segment + 2 < n && walked + here < want) {
      walked += here;
      ++segment;
      here = length(polyline[segment + 1] - polyline[segment]);
    }
    const float u = here > 0 ? det::clamp((want - walked) / here, 0.0f, 1.0f) : 0.0f;
    axis.points[static_cast<std::size_t>(j)] = lerp(polyline[segment], polyline[segment + 1], u);
  }
  return axis;
}

Vec2 point_at(const Axis& axis, float s) {
  const float at = det::clamp(s, 0.0f, 1.0f) * kLast;
  const int j = min_int(static_cast<int>(at), kLast - 1);
  return lerp(axis.points[static_cast<std::size_t>(j)], axis.points[static_cast<std::size_t>(j) + 1],
              at - static_cast<float>(j));
}

Vec2 tangent_at(const Axis& axis, float s) {
  const int j = clamp_int(static_cast<int>(s * kLast), 0, kLast - 1);
  const int a = max_int(j - 1, 0), b = min_int(j + 2, kLast);
  return normalised(axis.points[static_cast<std::size_t>(b)] - axis.points[static_cast<std::size_t>(a)]);
}

void project_outline(std::span<const Vec2> contour, Stretch right, const Axis& axis, std::span<AlongAxis> out) {
  const int n = static_cast<int>(contour.size());
  const Segments segments(axis);
  int segment = 0;
  for (int k = 0; k <= right.count; ++k) {
    const std::size_t i = static_cast<std::size_t>((right.begin + k) % n);
    out[i] = nearest_from(segments, contour[i], segment);
  }
  segment = 0;  // the left side, from the head backwards
  for (int k = 1; k < n - right.count; ++k) {
    const std::size_t i = static_cast<std::size_t>((right.begin - k + n) % n);
    out[i] = nearest_from(segments, contour[i], segment);
  }
}

WidthProfile width_profile(std::span<const AlongAxis> along, Stretch right) {
  WidthProfile widths;
  const int n = static_cast<int>(along.size());
  for (int side = 0; side < 2; ++side) {
    auto& profile = widths.side[side];
    for (float& v : profile) v = -1;
    const bool is_right = side == 1;
    const int begin = is_right ? right.begin : (right.begin + right.count) % n;
    const int count = is_right ? right.count : n - right.count;
    for (int k = 0; k < count; ++k) {
      const AlongAxis a = along[static_cast<std::size_t>((begin + k) % n)];
      const AlongAxis b = along[static_cast<std::size_t>((begin + k + 1) % n)];
      add_edge(profile, a, b, is_right ? 1.0f : -1.0f);
    }
    fill_gaps(profile);
  }
  return widths;
}

StationValues body_half_width(const WidthProfile& widths) {
  StationValues mean;
  for (std::size_t j = 0; j < kStations; ++j) mean[j] = 0.5f * (widths.side[0][j] + widths.side[1][j]);
  return lower_envelope(mean, kBodyStiffness);
}

Axis centred(const Axis& axis, const WidthProfile& widths, const StationValues& body) {
  StationValues shift, weights;
  for (int j = 0; j < kStations; ++j) {
    const std::size_t i = static_cast<std::size_t>(j);
    shift[i] = 0.5f * (widths.side[1][i] - widths.side[0][i]);
    const float mean = 0.5f * (widths.side[1][i] + widths.side[0][i]);
    const bool has_fin = j >= kFinsFrom && j <= kFinsTo && mean > kFinWidth * body[i] + kFinExcess * axis.length;
    const bool is_cap = j < 2 || j > kLast - 2;  // half-widths there end with the outline
    weights[i] = has_fin || is_cap ? 0.0f : 1.0f;
  }
  shift = smoothed(shift, weights, kAxisStiffness);
  Vec2 moved[kStations];
  for (int j = 0; j < kStations; ++j) {
    const Vec2 forward = tangent_at(axis, static_cast<float>(j) / kLast) * -1.0f;  // towards the head
    moved[j] = axis.points[static_cast<std::size_t>(j)] + right_of(forward) * shift[static_cast<std::size_t>(j)];
  }
  return resampled(moved);
}

Axis joined_to_ends(const Axis& axis, const AxisEnds& ends) {
  return with_ends(axis, reliable_part(axis, ends), ends.head, ends.tail);
}

Axis extended_to_outline(const Axis& axis, std::span<const Vec2> contour, const AxisEnds& ends) {
  const Reliable part = reliable_part(axis, ends);
  const float reach = 0.25f * axis.length;
  const auto end_point = [&](int at, int inner, Vec2 end, float near) {
    const Vec2 p = axis.points[static_cast<std::size_t>(at)];
    const Vec2 dir = normalised(p - axis.points[static_cast<std::size_t>(inner)]);
    const float along = ray_to_contour(contour, p, dir, reach);
    const Vec2 hit = p + dir * along;
    return along >= 0 && length_sq(hit - end) < near * near ? hit : end;
  };
  return with_ends(
      axis, part, end_point(part.first, part.first + 4, ends.head, kNearHead * axis.length),
      end_point(part.last, part.last - 4, ends.tail, (ends.notched ? kNearNotch : kNearEnd) * axis.length));
}

}  // namespace nt
