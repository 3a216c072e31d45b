// SPDX-License-Identifier: Apache-2.0
// The control points of a character as they are corrected: named, in the pixels of the figure. Off the frame path.
//
// Frame of reference: figure pixels, x right, y down, pixel centres at integers. They are the pixels of `--preview`, and
// they do not move when a control point does (character units do: their origin is the centre).
// Names: centre, head, tail, up_axis_1 (beside the centre) to up_axis_N, low_axis_1 to low_axis_N, and for each fin its
// tip and its two junctions as in the pose CSV: l_fin, jun_tl, jun_bl, r_fin, jun_tr, jun_br; the second pair ends in _2.
// Cost: microseconds.
#pragma once
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/character/character.h"

namespace nt {

struct RigFin {
  bool present = false;
  Vec2 tip, top, bottom;  // top: the junction on the head's side
  float confidence = 0;
};

struct Rig {
  int u_num = 3, l_num = 15;
  int harmonics = 5;  // S, of the outline that the proposal was made from
  Vec2 centre, head, tail;
  Vec2 up_axis[kMaxUpAxis], low_axis[kMaxLowAxis];  // [0] beside the centre
  RigFin fins[kMaxFins];                            // FinIndex
  float centre_confidence = 0, head_confidence = 0, tail_confidence = 0;
  float up_confidence[kMaxUpAxis] = {}, low_confidence[kMaxLowAxis] = {};
  MlsKind deformer = MlsKind::rigid;
  bool has_tail_fin = true;
  bool flip = false;  // the character is the figure's mirror image
};

enum class PointKind : uint8_t { centre, head, tail, up_axis, low_axis, fin_tip, fin_top, fin_bottom };
struct PointId {
  PointKind kind = PointKind::centre;
  int index = 0;  // of the axis, or of the fin
  auto operator<=>(const PointId&) const = default;
  bool of_fin() const { return kind >= PointKind::fin_tip; }
};

std::string point_name(PointId id);
// Any name that a rig may have, with u_num and l_num at their largest.
std::vector<std::string> all_point_names();
std::optional<PointId> point_named(const std::string& name);

bool has_point(const Rig& rig, PointId id);
std::vector<PointId> points_of(const Rig& rig);
Vec2 point_at(const Rig& rig, PointId id);
void place_point(Rig& rig, PointId id, Vec2 at);  // has_point must hold
float point_confidence(const Rig& rig, PointId id);
void set_point_confidence(Rig& rig, PointId id, float confidence);  // of a fin: of all its points
void set_axis_confidence(Rig& rig, float confidence);               // of the points between head, centre and tail
// The same point of the other side's fin; a point of the axis is its own.
PointId other_side(PointId id);

// Head to tail through every axis point.
std::vector<Vec2> midline_of(const Rig& rig);
float midline_length(const Rig& rig);
// The mirror image of p in the midline, which goes on straight beyond head and tail.
Vec2 mirrored(const Rig& rig, Vec2 p);

// Takes `line` (head to tail, at least two points apart) as the midline: the centre goes to the place on it nearest to
// where it was, the axis points are spread evenly between it and the ends.
void lay_midline(Rig& rig, std::span<const Vec2> line);
// The same midline with other numbers of axis points.
void set_axis_numbers(Rig& rig, int u_num, int l_num);
// The head becomes the tail: the axis is reversed, left and right change over, junctions too.
void swap_ends(Rig& rig);

// A fin for a tip at `tip`: its junctions between the midline and the tip.
void place_fin(Rig& rig, int fin, Vec2 tip);
// A fin where fish have them, when nothing is known: mirrored from the other side where that has one.
void propose_fin(Rig& rig, int fin);

}  // namespace nt
