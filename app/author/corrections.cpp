// SPDX-License-Identifier: Apache-2.0
#include "app/author/corrections.h"

#include <algorithm>
#include <cmath>

#include "app/author/polyline.h"
#include "platform/camera.h"

namespace nt {
namespace {

// Of the midline's length: shorter bones than this leave a joint without a direction.
constexpr float kLeastBone = 1e-3f;

Vec2 direction_of(const std::string& word) {
  if (word == "left") return {-1, 0};
  if (word == "right") return {1, 0};
  if (word == "up") return {0, -1};
  return {0, 1};
}

bool ends_are_swapped(const Rig& rig, const HeadEnd& end) {
  if (end.word.empty()) return length(rig.tail - end.point) < length(rig.head - end.point);
  const Vec2 to = direction_of(end.word);
  return dot(rig.tail, to) > dot(rig.head, to);
}

void set_fin_pairs(Rig& rig, int pairs) {
  for (int fin = 0; fin < kMaxFins; ++fin) {
    if (fin >= 2 * pairs) rig.fins[fin] = {};
    else if (!rig.fins[fin].present) propose_fin(rig, fin);
  }
}

// Every moved point, and with `mirror` what follows from it on the other side.
std::map<PointId, Vec2> all_moved(const Rig& rig, const Corrections& c) {
  std::map<PointId, Vec2> moved = c.moved;
  if (!c.mirror.value_or(false)) return moved;
  Rig axis = rig;  // mirrored in the midline as it will be
  for (const auto& [id, at] : c.moved) {
    if (!id.of_fin() && has_point(axis, id)) place_point(axis, id, at);
  }
  for (const auto& [id, at] : c.moved) {
    if (id.of_fin() && !c.removed[id.index ^ 1]) moved.try_emplace(other_side(id), tidy(mirrored(axis, at)));
  }
  return moved;
}

std::string what_it_needs(const Rig& rig, PointId id) {
  if (id.of_fin()) return "; this fin needs its tip, " + point_name({PointKind::fin_tip, id.index}) + ", too";
  return "; the character has u_num " + std::to_string(rig.u_num) + " and l_num " + std::to_string(rig.l_num);
}

void move_points(Rig& rig, const std::map<PointId, Vec2>& moved) {
  for (const auto& [id, at] : moved) {
    if (id.kind == PointKind::fin_tip && !rig.fins[id.index].present) place_fin(rig, id.index, at);
  }
  for (const auto& [id, at] : moved) {
    if (!has_point(rig, id)) throw UserError("corrections: there is no " + point_name(id) + what_it_needs(rig, id), 2);
    place_point(rig, id, at);
    set_point_confidence(rig, id, 1);
  }
}

void check_bones(const Rig& rig) {
  const std::vector<Vec2> line = midline_of(rig);
  const float least = kLeastBone * line_length(line);
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (length(line[i] - line[i - 1]) > least) continue;
    throw UserError("corrections: two neighbouring points of the midline lie on each other; move them apart", 2);
  }
}

}  // namespace

Vec2 tidy(Vec2 p) { return {std::round(p.x * 10) / 10, std::round(p.y * 10) / 10}; }

Rig corrected(Rig rig, const Corrections& c) {
  // A drawn midline says which end is the head, too.
  const std::optional<HeadEnd> end = c.midline.empty() ? c.head_end : HeadEnd{"", c.midline.front()};
  if (end && ends_are_swapped(rig, *end)) swap_ends(rig);
  if (end) rig.head_confidence = rig.tail_confidence = 1;
  // Axis points are spread on both sides of the centre as it will be.
  if (const auto centre = c.moved.find({PointKind::centre, 0}); centre != c.moved.end()) rig.centre = centre->second;
  set_axis_numbers(rig, c.u_num.value_or(rig.u_num), c.l_num.value_or(rig.l_num));
  rig.harmonics = c.harmonics.value_or(rig.harmonics);
  if (!c.midline.empty()) {
    lay_midline(rig, c.midline);
    set_axis_confidence(rig, 1);
  }
  if (c.fin_pairs) set_fin_pairs(rig, *c.fin_pairs);
  for (int fin = 0; fin < kMaxFins; ++fin) {
    if (c.removed[fin]) rig.fins[fin] = {};
  }
  move_points(rig, all_moved(rig, c));
  check_bones(rig);
  rig.has_tail_fin = c.tail_fin.value_or(rig.has_tail_fin);
  rig.flip = c.flip.value_or(rig.flip);
  rig.deformer = c.deformer.value_or(rig.deformer);
  return rig;
}

}  // namespace nt
