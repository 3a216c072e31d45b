// SPDX-License-Identifier: Apache-2.0
#include "app/author/rig.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "app/author/polyline.h"

namespace nt {
namespace {

// Of the midline's length: the centre keeps so far from both ends.
constexpr float kLeastShare = 0.1f;
// Where a fin is put when nothing is known: its root's place from the head on, the tip's distance from the midline, and
// how far the tip lies behind the root; shares of the midline's length, pair by pair.
constexpr float kFinAt[2] = {0.3f, 0.6f};
constexpr float kFinReach = 0.2f;
constexpr float kFinSweep = 0.08f;
// Junctions of a fin that is only known by its tip: how far out, as a share of the tip's distance, and half their distance
// as a share of the midline's length.
constexpr float kRootShare = 0.4f;
constexpr float kHalfRoot = 0.04f;

struct FinNames {
  const char* tip;
  const char* top;
  const char* bottom;
};
constexpr FinNames kFinNames[kMaxFins] = {{"l_fin", "jun_tl", "jun_bl"},
                                          {"r_fin", "jun_tr", "jun_br"},
                                          {"l_fin_2", "jun_tl_2", "jun_bl_2"},
                                          {"r_fin_2", "jun_tr_2", "jun_br_2"}};

std::map<std::string, PointId> make_names() {
  std::map<std::string, PointId> names;
  const auto add = [&](PointId id) { names[point_name(id)] = id; };
  for (const PointKind kind : {PointKind::centre, PointKind::head, PointKind::tail}) add({kind, 0});
  for (int i = 0; i < kMaxUpAxis; ++i) add({PointKind::up_axis, i});
  for (int i = 0; i < kMaxLowAxis; ++i) add({PointKind::low_axis, i});
  for (int i = 0; i < kMaxFins; ++i) {
    for (const PointKind kind : {PointKind::fin_tip, PointKind::fin_top, PointKind::fin_bottom}) add({kind, i});
  }
  return names;
}

const std::map<std::string, PointId>& names() {
  static const std::map<std::string, PointId> all = make_names();
  return all;
}

Vec2* slot(Rig& rig, PointId id) {
  switch (id.kind) {
    case PointKind::centre:
      return &rig.centre;
    case PointKind::head:
      return &rig.head;
    case PointKind::tail:
      return &rig.tail;
    case PointKind::up_axis:
      return &rig.up_axis[id.index];
    case PointKind::low_axis:
      return &rig.low_axis[id.index];
    case PointKind::fin_tip:
      return &rig.fins[id.index].tip;
    case PointKind::fin_top:
      return &rig.fins[id.index].top;
    case PointKind::fin_bottom:
      break;
  }
  return &rig.fins[id.index].bottom;
}

float* confidence_slot(Rig& rig, PointId id) {
  if (id.of_fin()) return &rig.fins[id.index].confidence;
  if (id.kind == PointKind::head) return &rig.head_confidence;
  if (id.kind == PointKind::tail) return &rig.tail_confidence;
  if (id.kind == PointKind::up_axis) return &rig.up_confidence[id.index];
  if (id.kind == PointKind::low_axis) return &rig.low_confidence[id.index];
  return &rig.centre_confidence;
}

// +1: a positive cross product with the midline's direction, head to tail. With y down that is the fish's left.
float side_of(int fin) { return fin % 2 == 0 ? 1.0f : -1.0f; }

}  // namespace

std::string point_name(PointId id) {
  switch (id.kind) {
    case PointKind::centre:
      return "centre";
    case PointKind::head:
      return "head";
    case PointKind::tail:
      return "tail";
    case PointKind::up_axis:
      return "up_axis_" + std::to_string(id.index + 1);
    case PointKind::low_axis:
      return "low_axis_" + std::to_string(id.index + 1);
    case PointKind::fin_tip:
      return kFinNames[id.index].tip;
    case PointKind::fin_top:
      return kFinNames[id.index].top;
    case PointKind::fin_bottom:
      break;
  }
  return kFinNames[id.index].bottom;
}

std::vector<std::string> all_point_names() {
  std::vector<std::string> all;
  for (const auto& [name, id] : names()) all.push_back(name);
  return all;
}

std::optional<PointId> point_named(const std::string& name) {
  const auto found = names().find(name);
  if (found == names().end()) return std::nullopt;
  return found->second;
}

bool has_point(const Rig& rig, PointId id) {
  if (id.index < 0) return false;
  if (id.kind == PointKind::up_axis) return id.index < rig.u_num;
  if (id.kind == PointKind::low_axis) return id.index < rig.l_num;
  if (id.of_fin()) return id.index < kMaxFins && rig.fins[id.index].present;
  return true;
}

std::vector<PointId> points_of(const Rig& rig) {
  std::vector<PointId> all;
  for (const auto& [name, id] : names()) {
    if (has_point(rig, id)) all.push_back(id);
  }
  std::sort(all.begin(), all.end());
  return all;
}

Vec2 point_at(const Rig& rig, PointId id) { return *slot(const_cast<Rig&>(rig), id); }
void place_point(Rig& rig, PointId id, Vec2 at) { *slot(rig, id) = at; }

float point_confidence(const Rig& rig, PointId id) { return *confidence_slot(const_cast<Rig&>(rig), id); }
void set_point_confidence(Rig& rig, PointId id, float confidence) { *confidence_slot(rig, id) = confidence; }

void set_axis_confidence(Rig& rig, float confidence) {
  std::fill(std::begin(rig.up_confidence), std::end(rig.up_confidence), confidence);
  std::fill(std::begin(rig.low_confidence), std::end(rig.low_confidence), confidence);
}

PointId other_side(PointId id) {
  if (id.of_fin()) id.index ^= 1;
  return id;
}

std::vector<Vec2> midline_of(const Rig& rig) {
  std::vector<Vec2> line{rig.head};
  for (int i = rig.u_num - 1; i >= 0; --i) line.push_back(rig.up_axis[i]);
  line.push_back(rig.centre);
  line.insert(line.end(), rig.low_axis, rig.low_axis + rig.l_num);
  line.push_back(rig.tail);
  return line;
}

float midline_length(const Rig& rig) { return line_length(midline_of(rig)); }

Vec2 mirrored(const Rig& rig, Vec2 p) {
  const std::vector<Vec2> line = midline_of(rig);
  const Vec2 foot = nearest_on_line(line, p, LineEnds::go_on).at;
  return foot + foot - p;
}

void lay_midline(Rig& rig, std::span<const Vec2> line) {
  const float whole = line_length(line);
  const float nearest = nearest_on_line(line, rig.centre, LineEnds::stop).along;
  const float centre = std::clamp(nearest, kLeastShare * whole, (1 - kLeastShare) * whole);
  rig.head = line.front(), rig.tail = line.back();
  rig.centre = along_line(line, centre);
  for (int i = 0; i < rig.u_num; ++i) {
    rig.up_axis[i] = along_line(line, centre * (1 - static_cast<float>(i + 1) / static_cast<float>(rig.u_num + 1)));
  }
  for (int i = 0; i < rig.l_num; ++i) {
    const float share = static_cast<float>(i + 1) / static_cast<float>(rig.l_num + 1);
    rig.low_axis[i] = along_line(line, centre + (whole - centre) * share);
  }
}

void set_axis_numbers(Rig& rig, int u_num, int l_num) {
  if (u_num == rig.u_num && l_num == rig.l_num) return;
  const std::vector<Vec2> line = rounded_line(midline_of(rig));
  const float least = std::min(*std::min_element(rig.up_confidence, rig.up_confidence + rig.u_num),
                               *std::min_element(rig.low_confidence, rig.low_confidence + rig.l_num));
  rig.u_num = u_num, rig.l_num = l_num;
  set_axis_confidence(rig, least);
  lay_midline(rig, line);
}

void swap_ends(Rig& rig) {
  std::vector<Vec2> line = rounded_line(midline_of(rig));
  std::reverse(line.begin(), line.end());
  lay_midline(rig, line);
  std::swap(rig.head_confidence, rig.tail_confidence);
  for (int pair = 0; pair < kMaxFins; pair += 2) std::swap(rig.fins[pair], rig.fins[pair + 1]);
  for (RigFin& fin : rig.fins) std::swap(fin.top, fin.bottom);
}

void place_fin(Rig& rig, int fin, Vec2 tip) {
  const std::vector<Vec2> line = midline_of(rig);
  const OnLine foot = nearest_on_line(line, tip, LineEnds::stop);
  const Vec2 root = lerp(foot.at, tip, kRootShare);
  const Vec2 half = direction_of_line(line, foot.along) * (kHalfRoot * line_length(line));
  rig.fins[fin] = {true, tip, root - half, root + half, 0};
}

void propose_fin(Rig& rig, int fin) {
  const RigFin& other = rig.fins[fin ^ 1];
  if (other.present) {
    rig.fins[fin] = {true, mirrored(rig, other.tip), mirrored(rig, other.top), mirrored(rig, other.bottom), 0};
    return;
  }
  const std::vector<Vec2> line = midline_of(rig);
  const float whole = line_length(line), along = kFinAt[fin / 2] * whole;
  const Vec2 back = direction_of_line(line, along);
  const Vec2 out = right_of(back) * side_of(fin);
  const Vec2 base = along_line(line, along);
  const Vec2 root = base + out * (kRootShare * kFinReach * whole);
  const Vec2 half = back * (kHalfRoot * whole);
  rig.fins[fin] = {true, base + out * (kFinReach * whole) + back * (kFinSweep * whole), root - half, root + half, 0};
}

}  // namespace nt
