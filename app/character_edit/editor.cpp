// SPDX-License-Identifier: Apache-2.0
#include "app/character_edit/editor.h"

#include <algorithm>
#include <utility>

#include "app/author/polyline.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr std::size_t kMostUndo = 200;
// Ends and fins are found before the many points of the axis that may lie around them.
constexpr float kAxisHandicap = 1.6f;
// A stroke is a midline from this share of the present one's length on; less is a slip.
constexpr float kLeastStroke = 0.25f;
constexpr int kStrokePoints = 20;
constexpr int kStrokeCalming = 4;
// A pointer that moves less than this share of the reach is a tap.
constexpr float kTapShare = 0.5f;

bool of_axis(PointId id) { return id.kind == PointKind::up_axis || id.kind == PointKind::low_axis; }

void forget_axis(Corrections& c) {
  std::erase_if(c.moved, [](const auto& point) { return !point.first.of_fin(); });
}

void forget_fin(Corrections& c, int fin) {
  std::erase_if(c.moved, [&](const auto& point) { return point.first.of_fin() && point.first.index == fin; });
}

std::vector<Vec2> tidied(std::vector<Vec2> line) {
  for (Vec2& p : line) p = tidy(p);
  return line;
}

// Where a fin's point goes when head and tail change places.
PointId swapped(PointId id) {
  if (!id.of_fin()) return id;
  id.index ^= 1;
  if (id.kind == PointKind::fin_top) id.kind = PointKind::fin_bottom;
  else if (id.kind == PointKind::fin_bottom) id.kind = PointKind::fin_top;
  return id;
}

}  // namespace

std::string plain_name(PointId id) {
  const std::string number = std::to_string(id.index + 1);
  if (id.kind == PointKind::centre) return "centre";
  if (id.kind == PointKind::head) return "head";
  if (id.kind == PointKind::tail) return "tail";
  if (id.kind == PointKind::up_axis) return "head joint " + number;
  if (id.kind == PointKind::low_axis) return "tail joint " + number;
  const std::string fin = std::string(id.index >= 2 ? "second " : "") + (id.index % 2 == 0 ? "left fin" : "right fin");
  if (id.kind == PointKind::fin_tip) return fin + ", tip";
  return fin + (id.kind == PointKind::fin_top ? ", front root" : ", rear root");
}

Editor::Editor(const Rig& found, const Corrections& corrections, Propose propose)
    : propose_(std::move(propose)), state_{found, corrections}, rig_(corrected(found, corrections)) {
  if (!mirror()) return;
  // What follows from the mirror is said outright, so that switching it off moves nothing.
  std::map<PointId, Vec2>& moved = state_.corrections.moved;
  for (const auto& [id, at] : std::map<PointId, Vec2>(moved)) {
    if (id.of_fin() && has_point(rig_, other_side(id)))
      moved.try_emplace(other_side(id), point_at(rig_, other_side(id)));
  }
}

void Editor::show(const State& state) {
  rig_ = corrected(state.found, state.corrections);
  state_ = state;
  ++revision_;
  if (selected_ && !has_point(rig_, *selected_)) selected_.reset();
}

void Editor::change(const std::string& gesture, const std::function<void(State&)>& make) {
  const State before = state_;
  State after = state_;
  try {
    make(after);
    show(after);
  } catch (const UserError&) {
    return;
  }
  const bool goes_on = !gesture.empty() && gesture == gesture_;
  gesture_ = gesture;
  future_.clear();
  if (goes_on) return;
  past_.push_back(before);
  if (past_.size() > kMostUndo) past_.erase(past_.begin());
}

void Editor::undo() {
  if (past_.empty()) return;
  future_.push_back(state_);
  const State before = past_.back();
  past_.pop_back();
  gesture_.clear();
  show(before);
}

void Editor::redo() {
  if (future_.empty()) return;
  past_.push_back(state_);
  const State after = future_.back();
  future_.pop_back();
  gesture_.clear();
  show(after);
}

void Editor::choose(Tool tool) {
  release();
  tool_ = tool;
}

std::optional<PointId> Editor::hit(Vec2 at, float reach) const {
  std::optional<PointId> best;
  float nearest = reach;
  for (const PointId id : points_of(rig_)) {
    const float distance = length(point_at(rig_, id) - at);
    const float counted = of_axis(id) ? distance * kAxisHandicap : distance;
    if (distance <= reach && (counted < nearest || !best)) nearest = counted, best = id;
  }
  return best;
}

void Editor::press(Vec2 at, float reach) {
  end_gesture();
  pressed_at_ = at, tap_reach_ = kTapShare * reach;
  if (tool_ == Tool::midline) {
    stroke_ = {at};
    return;
  }
  if (tool_ == Tool::fins) {
    press_fin(at, reach);
    return;
  }
  held_ = hit(at, reach);
  if (!held_) return;
  selected_ = held_;
  grip_ = point_at(rig_, *held_) - at;
}

// The side of the midline says left or right; the first place that is free is taken, else the nearer fin.
int Editor::fin_for(Vec2 at) const {
  const std::vector<Vec2> line = midline_of(rig_);
  const OnLine foot = nearest_on_line(line, at, LineEnds::stop);
  const int side = cross(direction_of_line(line, foot.along), at - foot.at) > 0 ? 0 : 1;
  for (int fin = side; fin < kMaxFins; fin += 2) {
    if (!rig_.fins[fin].present) return fin;
  }
  const auto distance = [&](int fin) { return length_sq(rig_.fins[fin].tip - at); };
  return distance(side) <= distance(side + 2) ? side : side + 2;
}

void Editor::press_fin(Vec2 at, float reach) {
  const std::optional<PointId> near = hit(at, reach);
  if (near && near->of_fin()) {
    held_ = selected_ = near;
    grip_ = point_at(rig_, *near) - at;
    tapped_ = near->kind == PointKind::fin_tip;
    return;
  }
  const PointId tip{PointKind::fin_tip, fin_for(at)};
  move_to(tip, at);
  if (!has_point(rig_, tip)) return;
  held_ = selected_ = tip;
  grip_ = {};
}

void Editor::move_to(PointId id, Vec2 at) {
  change("move " + point_name(id), [&](State& state) {
    Corrections& c = state.corrections;
    c.moved[id] = tidy(at);
    if (!id.of_fin()) return;
    c.removed[id.index] = false;
    if (!mirror()) return;
    const PointId other = other_side(id);
    if (id.kind != PointKind::fin_tip && !has_point(rig_, other)) return;
    c.removed[other.index] = false;
    c.moved[other] = tidy(mirrored(rig_, at));
  });
}

void Editor::drag(Vec2 at) {
  if (!stroke_.empty()) {
    if (length(at - stroke_.back()) > 0.2f * tap_reach_) stroke_.push_back(at);
    return;
  }
  if (!held_) return;
  if (tapped_ && length(at - pressed_at_) < tap_reach_) return;
  tapped_ = false;
  move_to(*held_, at + grip_);
}

void Editor::release() {
  if (!stroke_.empty()) finish_stroke();
  if (tapped_ && held_) {
    const int fin = held_->index;
    change("", [&](State& state) {
      for (const int gone : {fin, mirror() ? fin ^ 1 : fin}) {
        forget_fin(state.corrections, gone);
        state.corrections.removed[gone] = true;
      }
    });
  }
  tapped_ = false;
  held_.reset();
  end_gesture();
}

void Editor::finish_stroke() {
  const std::vector<Vec2> drawn = std::exchange(stroke_, {});
  if (line_length(drawn) < kLeastStroke * midline_length(rig_)) return;
  std::vector<Vec2> line = evenly(calmed(evenly(drawn, 4 * kStrokePoints), kStrokeCalming), kStrokePoints);
  const bool from_tail = length(line.front() - rig_.head) + length(line.back() - rig_.tail) >
                         length(line.front() - rig_.tail) + length(line.back() - rig_.head);
  if (from_tail) std::reverse(line.begin(), line.end());
  change("", [&](State& state) {
    forget_axis(state.corrections);
    state.corrections.midline = tidied(line);
  });
}

// Points of the axis that were moved become a drawn midline: their numbers are about to mean other places.
void Editor::keep_shape(State& state) const {
  Corrections& c = state.corrections;
  const bool any = std::any_of(c.moved.begin(), c.moved.end(), [](const auto& p) { return !p.first.of_fin(); });
  if (!any) return;
  forget_axis(c);
  c.midline = tidied(evenly(rounded_line(midline_of(rig_)), kStrokePoints));
}

void Editor::set_mirror(bool on) {
  change("", [&](State& state) { state.corrections.mirror = on; });
}

void Editor::set_flip(bool on) {
  change("", [&](State& state) { state.corrections.flip = on; });
}

void Editor::set_tail_fin(bool on) {
  change("", [&](State& state) { state.corrections.tail_fin = on; });
}

void Editor::set_deformer(MlsKind kind) {
  change("", [&](State& state) { state.corrections.deformer = kind; });
}

int Editor::fin_pairs() const {
  const auto pair = [&](int first) { return rig_.fins[first].present || rig_.fins[first + 1].present; };
  return pair(2) ? 2 : pair(0) ? 1 : 0;
}

void Editor::set_fin_pairs(int pairs) {
  change("", [&](State& state) {
    Corrections& c = state.corrections;
    c.fin_pairs = pairs;
    for (int fin = 0; fin < kMaxFins; ++fin) {
      c.removed[fin] = false;
      if (fin >= 2 * pairs) forget_fin(c, fin);
    }
  });
}

void Editor::set_axis(int u_num, int l_num) {
  if (u_num == rig_.u_num && l_num == rig_.l_num) return;
  change("axis", [&](State& state) {
    keep_shape(state);
    state.corrections.u_num = u_num, state.corrections.l_num = l_num;
  });
}

void Editor::set_harmonics(int harmonics) {
  if (harmonics == rig_.harmonics) return;
  change("harmonics", [&](State& state) {
    state.found = propose_(rig_, harmonics);
    state.corrections.harmonics = harmonics;
  });
}

void Editor::swap_head_and_tail() {
  change("", [&](State& state) {
    Corrections& c = state.corrections;
    keep_shape(state);
    c.head_end = HeadEnd{"", tidy(rig_.tail)};
    std::reverse(c.midline.begin(), c.midline.end());
    std::map<PointId, Vec2> moved;
    for (const auto& [id, at] : c.moved) moved[swapped(id)] = at;
    c.moved = moved;
    for (int pair = 0; pair < kMaxFins; pair += 2) std::swap(c.removed[pair], c.removed[pair + 1]);
  });
}

void Editor::propose_anew() {
  change("", [&](State& state) {
    state.found = propose_(rig_, rig_.harmonics);
    Corrections& c = state.corrections;
    c.moved.clear();
    c.midline.clear();
    c.fin_pairs.reset();
    std::fill(std::begin(c.removed), std::end(c.removed), false);
  });
}

void Editor::nudge(Vec2 by) {
  if (selected_) move_to(*selected_, point_at(rig_, *selected_) + by);
}

}  // namespace nt
