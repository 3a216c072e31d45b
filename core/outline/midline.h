// SPDX-License-Identifier: Apache-2.0
// The medial axis of a fish outline ([F] section 4.3): contour, head, tail -> polyline from head to tail.
//
// Two steps. (1) The paper's: both sides of the elliptic Fourier reconstruction, resampled by arc length to the same count
// (the limit of Eq 1's floor index), averaged. (2) Ours: the original outline is expressed along that axis as half-widths
// to its left and right, fins cut off at their junctions, and every axis point moves to the middle between them; the ends
// run on to where the axis leaves the outline. Step 2 exists because five harmonics cannot follow a thin bent tail and a
// one-sided fin pulls the smooth outline: measured on the tank it lowers the rms error (docs/METHOD.md gives figures).
// Frame of reference: the contour's. Cost: O(contour points), three passes.
#pragma once
#include <array>
#include <span>

#include "core/base/vec2.h"
#include "core/outline/fourier.h"
#include "core/outline/smoother.h"

namespace nt {

struct Axis {
  std::array<Vec2, kStations> points{};
  float length = 0;
};

// A point's place along the axis: s in [0, 1] from head to tail, d to the fish's right in pixels.
struct AlongAxis {
  float s = 0;
  float d = 0;
};

// Half-widths at the stations, pixels; both positive. Index 0 = left of the fish, 1 = right.
struct WidthProfile {
  StationValues side[2];
};

// A stretch of a contour, from index `begin` onwards `count` points, wrapping around.
struct Stretch {
  int begin = 0;
  int count = 0;
};

// Step 1. t_head and t_tail are arc-length fractions; the contour runs clockwise on the screen, so head -> tail in
// contour order is the fish's right side. `smooth` (2 * kStations points) receives the reconstruction, right side then
// left side backwards, as a closed contour.
Axis medial_axis(const EllipticFourier& fourier, float t_head, float t_tail, std::span<Vec2> smooth);

// Uniform stations along a polyline, and its length.
Axis resampled(std::span<const Vec2> polyline);
Vec2 point_at(const Axis& axis, float s);
Vec2 tangent_at(const Axis& axis, float s);  // unit, from head to tail

// (s, d) of the points of a contour, walking along both in step. `right` = the stretch from head to tail in contour order;
// the rest is the left side.
void project_outline(std::span<const Vec2> contour, Stretch right, const Axis& axis, std::span<AlongAxis> out);

// Half-widths from the projected outline, fins and all.
WidthProfile width_profile(std::span<const AlongAxis> along, Stretch right);

// The body's half-width without fins: the lower envelope of the mean of both sides (which does not depend on how well the
// axis is centred).
StationValues body_half_width(const WidthProfile& widths);

// Moves every station to the middle between its half-widths, smoothly. Stations where the outline is wider than `body` have
// a fin and are bridged.
Axis centred(const Axis& axis, const WidthProfile& widths, const StationValues& body);

// Where the axis ends, and the part before each end (share of the length) that is drawn straight and not measured.
struct AxisEnds {
  Vec2 head, tail;
  float head_trim = 0.05f, tail_trim = 0.05f;
  bool notched = false;  // `tail` lies between the tips of a forked fin: the axis ends there, and in neither lobe
};

// Draws the axis straight from its reliable part to the outline's end points.
Axis joined_to_ends(const Axis& axis, const AxisEnds& ends);

// As joined_to_ends, but each end runs straight on to where it leaves the contour, if that is near the outline's end point:
// the farthest point of a blunt snout or a slanting tail lies beside the axis.
Axis extended_to_outline(const Axis& axis, std::span<const Vec2> contour, const AxisEnds& ends);

}  // namespace nt
