// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/clip_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/take_edit/curves.h"

namespace nt {
namespace {

using Kind = Edit::Kind;
using Property = MotionProperty::Kind;

constexpr double kSmoothedSeconds = 0.2;  // what is shorter goes: jitter, not a tail beat
constexpr double kBlendedSeconds = 0.3;
constexpr double kSure = 0.5;
// Finer than a hand is, and short in a text file.
constexpr double kAngleSteps = 1e4, kPathSteps = 1e2;  // a radian, a pixel

// Of the first `count` edits how many are the last step: a position is set by two.
std::size_t last_step(const std::vector<Edit>& edits, std::size_t count) {
  if (count < 2) return count;
  const Edit &a = edits[count - 2], &b = edits[count - 1];
  const bool pair = a.kind == Kind::move && b.kind == Kind::move && a.what == "centre_x" && b.what == "centre_y";
  return pair && a.first == b.first && a.radius == b.radius && a.fish == b.fish ? 2 : 1;
}

}  // namespace

ClipEditor::ClipEditor(std::vector<Motion> recorded, std::vector<Edit> edits, double fps, int fish)
    : recorded_(std::move(recorded)),
      rest_(straight_motion(recorded_.front().u_num, recorded_.front().l_num)),
      fps_(fps),
      fish_(fish),
      edits_(std::move(edits)),
      radius_(std::max(2, static_cast<int>(std::lround(fps / 2)))) {
  apply_list();
}

int64_t ClipEditor::recorded_frame(int64_t frame) const {
  auto at = static_cast<double>(frame);
  for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit) {
    if (edit->kind == Kind::retime) at *= edit->value;
    else if (edit->renumbers()) at += static_cast<double>(edit->first);
  }
  return std::min<int64_t>(std::llround(at), static_cast<int64_t>(recorded_.size()) - 1);
}

void ClipEditor::go_to(int64_t frame) {
  if (!holding_) frame_ = std::clamp<int64_t>(frame, 0, frames() - 1);
}

void ClipEditor::begin_range() { range_ = {frame_, std::max(frame_, range_.last)}; }
void ClipEditor::end_range() { range_ = {std::min(frame_, range_.first), frame_}; }

EditWindow ClipEditor::window_of(const Setting& setting) const {
  const int r = static_cast<int>(frame_);
  const std::vector<Motion>& m = holding_ ? before_ : clip_.motions;
  if (setting.property.is_path()) return path_window(static_cast<int>(m.size()), r, radius_);
  return edit_window(m, setting.property, value_of(rest_, setting.property), r, setting.value);
}

EditWindow ClipEditor::window() const {
  return window_of({selected_, value_of(clip_.motions[static_cast<std::size_t>(frame_)], selected_)});
}

Edit ClipEditor::edit_of(const Setting& setting) const {
  const MotionProperty property = setting.property;
  char name[kPropertyNameSize];
  property_name(property, name);
  Edit edit;
  edit.kind = property.is_path() ? Kind::move : Kind::set;
  edit.what = name;
  edit.first = edit.last = frame_;
  edit.radius = property.is_path() ? radius_ : 0;
  edit.fish = fish_;
  const bool angle = property.kind != Property::centre_x && property.kind != Property::centre_y;
  const double steps = angle ? kAngleSteps : kPathSteps;
  edit.value = std::round(static_cast<double>(setting.value) * steps) / steps;
  return edit;
}

void ClipEditor::hold(MotionProperty property) {
  if (holding_) release();
  selected_ = property;
  before_ = clip_.motions;
  touched_ = {static_cast<int>(frame_), static_cast<int>(frame_)};
  holding_ = true;
}

void ClipEditor::drag_to(std::span<const Setting> settings) {
  if (!holding_) return;
  std::copy(before_.begin() + touched_.p, before_.begin() + touched_.q + 1, clip_.motions.begin() + touched_.p);
  held_.clear();
  touched_ = {static_cast<int>(frame_), static_cast<int>(frame_)};
  for (const Setting& setting : settings) {
    const EditWindow window = window_of(setting);
    held_.push_back(edit_of(setting));
    apply_edit(held_.back(), rest_, clip_);
    touched_ = {std::min(touched_.p, window.p), std::max(touched_.q, window.q)};
  }
  ++revision_;
}

void ClipEditor::release() {
  if (!holding_) return;
  holding_ = false;
  before_ = {};
  const std::vector<Edit> step = std::exchange(held_, {});
  if (step.empty()) return;
  edits_.insert(edits_.end(), step.begin(), step.end());  // the clip has them already
  undone_.clear();
  changed();
}

void ClipEditor::add(const std::vector<Edit>& step) {
  Clip next = clip_;
  for (const Edit& edit : step) apply_edit(edit, rest_, next);
  clip_ = std::move(next);
  if (std::any_of(step.begin(), step.end(), [](const Edit& edit) { return edit.renumbers(); })) mend_frames();
  edits_.insert(edits_.end(), step.begin(), step.end());
  changed();
}

void ClipEditor::commit(const Edit& edit) {
  add({edit});
  undone_.clear();
}

void ClipEditor::apply_list() {
  const auto frames_before = frames();
  clip_ = apply_edits(recorded_, rest_, fish_ < 0 ? edits_ : edits_for(edits_, fish_));
  if (frames() != frames_before) mend_frames();
}

// Frames have been numbered anew.
void ClipEditor::mend_frames() {
  frame_ = std::clamp<int64_t>(frame_, 0, frames() - 1);
  whole_range();
}

void ClipEditor::changed() { ++revision_, ++edits_revision_; }

Edit ClipEditor::of_range(Kind kind, const char* what, double value) const {
  Edit edit;
  edit.kind = kind, edit.what = what, edit.value = value;
  edit.first = range_.first, edit.last = range_.last;
  if (!edit.renumbers()) edit.fish = fish_;
  return edit;
}

void ClipEditor::smooth() {
  commit(of_range(Kind::smooth, group_of(selected_), std::max(4.0, std::round(kSmoothedSeconds * fps_))));
}

void ClipEditor::exaggerate(double factor) {
  if (selected_.is_path()) return;
  commit(of_range(Kind::exaggerate, group_of(selected_), factor));
}

void ClipEditor::repair() { commit(of_range(Kind::repair, "", kSure)); }

void ClipEditor::trim() {
  if (range_ == FrameRange{0, frames() - 1}) return;
  commit(of_range(Kind::trim, "", 0));
}

void ClipEditor::loop() {
  const double frames = static_cast<double>(range_.last - range_.first + 1);
  commit(of_range(Kind::loop, "", std::floor(std::min(kBlendedSeconds * fps_, 0.5 * frames))));
}

void ClipEditor::retime(double speed) {
  Edit edit;
  edit.kind = Kind::retime, edit.value = speed;
  commit(edit);
}

std::size_t ClipEditor::last_own() const {
  std::size_t end = edits_.size();
  while (end > 0 && !concerns_us(edits_[end - 1])) --end;
  return end;
}

void ClipEditor::undo() {
  if (holding_) {  // what is held was not yet a step
    drag_to({});
    release();
    return;
  }
  const std::size_t end = last_own();
  if (end == 0) return;
  const auto last = edits_.begin() + static_cast<std::ptrdiff_t>(end);
  const auto first = last - static_cast<std::ptrdiff_t>(last_step(edits_, end));
  undone_.emplace_back(first, last);
  edits_.erase(first, last);
  apply_list();
  changed();
}

void ClipEditor::redo() {
  if (holding_ || undone_.empty()) return;
  add(undone_.back());
  undone_.pop_back();
}

std::vector<int64_t> ClipEditor::keys(MotionProperty property) const {
  char name[kPropertyNameSize];
  property_name(property, name);
  std::vector<int64_t> frames;
  for (auto edit = edits_.rbegin(); edit != edits_.rend() && !edit->renumbers(); ++edit)
    if (concerns_us(*edit) && (edit->kind == Kind::set || edit->kind == Kind::move) && edit->what == name)
      frames.push_back(edit->first);
  return frames;
}

}  // namespace nt
