// SPDX-License-Identifier: Apache-2.0
#include "app/ui/take_canvas.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "app/ui/pane.h"
#include "app/ui/posed_character.h"
#include "app/ui/theme.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

constexpr float kNearShare = 0.85f;                  // of the area's shorter side
constexpr std::array<int, 4> kGhosts{-8, 8, -4, 4};  // frames away, the nearest is drawn last
constexpr float kGhostAlpha = 0.20f;
constexpr Colour kPast{0.45f, 0.65f, 1, kGhostAlpha}, kComing{1, 0.6f, 0.4f, kGhostAlpha};
constexpr Colour kUnedited{0.75f, 0.8f, 0.85f, 1};  // a shade cooler, so that before and after cannot be mistaken
constexpr Colour kCourse = rgb(0xE0662F, 0.6f);
constexpr float kNoPoseAlpha = 0.35f;
constexpr int64_t kWayFrames = 150;  // to either side
constexpr Colour kWay = rgb(0x1E7F8C, 0.55f), kWayBand = rgb(0xE0662F, 0.9f);
// Ends, fins and centre are found before the many joints that lie around them.
constexpr float kJointHandicap = 1.6f, kJointShare = 0.45f;

bool is_joint(MotionProperty property) { return property.kind == Kind::up_axis || property.kind == Kind::low_axis; }

Colour colour_of(MotionProperty property) {
  switch (property.kind) {
    case Kind::head:
      return kHeadPoint;
    case Kind::tail:
      return kTailPoint;
    case Kind::l_fin:
    case Kind::r_fin:
      return kTipPoint;
    case Kind::dir:
      return kMain;
    case Kind::centre_x:
    case Kind::centre_y:
      return kCentrePoint;
    case Kind::up_axis:
    case Kind::low_axis:
      break;
  }
  return kAxisPoint;
}

bool same_handle(MotionProperty handle, MotionProperty selected) {
  if (selected.kind == Kind::centre_y) selected.kind = Kind::centre_x;
  return handle == selected;
}

const Motion& at_frame(const ClipEditor& editor, int64_t frame) {
  return editor.motions()[static_cast<std::size_t>(std::clamp<int64_t>(frame, 0, editor.frames() - 1))];
}

}  // namespace

TakeCanvas::TakeCanvas(const Wardrobe& wardrobe, float init_len_px, Vec2 frame_px)
    : frame_px_(frame_px), puppet_(wardrobe, init_len_px), trial_(wardrobe, init_len_px) {
  for (std::size_t i = 0; i < kGhosts.size(); ++i) ghosts_.emplace_back(wardrobe, init_len_px);
}

void TakeCanvas::lay_out(const Area& area, const ClipEditor& editor, const CanvasLook& look) {
  if (editor.holding()) return;
  far_ = look.far;
  if (far_) {
    view_ = fit_figure({{0, 0}, frame_px_}, area, 0.02f * area.size.y, false);
    return;
  }
  view_.scale = kNearShare * std::min(area.size.x, area.size.y) / puppet_.length_px();
  view_.from = at_frame(editor, editor.frame()).centre;
  view_.to = area.centre();
}

void TakeCanvas::draw(Scene& scene, const ClipEditor& editor, const CanvasLook& look) {
  dots_.clear();
  if (far_) add_way(scene, editor, 0.2f * look.dot_px);
  if (look.ghosts && !look.before) add_ghosts(scene, editor);
  const Motion& shown = look.before ? editor.recorded_at(editor.frame()) : at_frame(editor, editor.frame());
  puppet_.pose(shown, view_);
  Colour tint = look.before ? kUnedited : Colour{};
  if (shown.status != PoseStatus::ok) tint.a = kNoPoseAlpha;
  add_posed(scene, puppet_.character(), puppet_.posed(), kFirstCharacterPicture, tint);
  if (look.handles && !look.before) add_handles(scene, editor, look.dot_px);
}

void TakeCanvas::add_ghosts(Scene& scene, const ClipEditor& editor) {
  for (std::size_t i = 0; i < kGhosts.size(); ++i) {
    const int64_t frame = editor.frame() + kGhosts[i];
    if (frame < 0 || frame >= editor.frames() || at_frame(editor, frame).status != PoseStatus::ok) continue;
    ghosts_[i].pose(at_frame(editor, frame), view_);
    add_posed(scene, ghosts_[i].character(), ghosts_[i].posed(), kFirstCharacterPicture,
              kGhosts[i] < 0 ? kPast : kComing);
  }
}

void TakeCanvas::add_way(Scene& scene, const ClipEditor& editor, float width_px) {
  way_.clear();
  const int64_t first = std::max<int64_t>(editor.frame() - kWayFrames, 0);
  const int64_t last = std::min(editor.frame() + kWayFrames, editor.frames() - 1);
  const EditWindow window = editor.window();
  std::vector<Vec2> moved;
  for (int64_t i = first; i <= last; ++i) {
    if (at_frame(editor, i).status != PoseStatus::ok) continue;
    way_.push_back(view_.to_scene(at_frame(editor, i).centre));
    if (i >= window.p && i <= window.q) moved.push_back(way_.back());
  }
  scene.lines(way_, kWay, width_px);
  if (editor.selected().is_path()) scene.lines(dots_.emplace_back(std::move(moved)), kWayBand, 2 * width_px);
}

void TakeCanvas::add_handles(Scene& scene, const ClipEditor& editor, float dot_px) {
  const auto keep = [&](std::vector<Vec2> points) { return std::span<const Vec2>(dots_.emplace_back(points)); };
  for (const Handle& handle : handles_of(puppet_)) {
    if (handle.property.kind == Kind::dir)
      scene.lines(keep({puppet_.posed().control_points().centre, handle.at}), kCourse, 0.12f * dot_px);
    const bool chosen = same_handle(handle.property, editor.selected());
    const float size = dot_px * (is_joint(handle.property) ? kJointShare : 1.0f) * (chosen ? 1.3f : 1.0f);
    const auto at = keep({handle.at});
    scene.points(at, chosen ? kHeld : kRim, size + (chosen ? 0.45f : 0.15f) * dot_px);
    if (chosen) scene.points(at, kRim, size + 0.2f * dot_px);
    scene.points(at, colour_of(handle.property), size);
  }
}

std::vector<Handle> TakeCanvas::handles(const ClipEditor& editor) {
  trial_.pose(at_frame(editor, editor.frame()), view_);
  return handles_of(trial_);
}

std::vector<Handle> TakeCanvas::handles_of(const Puppet& puppet) const {
  std::vector<Handle> handles = puppet.handles();
  if (far_) std::erase_if(handles, [](const Handle& handle) { return !handle.property.is_path(); });
  return handles;
}

std::optional<Handle> TakeCanvas::hit(const ClipEditor& editor, Vec2 at, float reach) {
  std::optional<Handle> best;
  float nearest = reach;
  for (const Handle& handle : handles(editor)) {
    const float far = length(at - handle.at) * (is_joint(handle.property) ? kJointHandicap : 1.0f);
    if (far < nearest) nearest = far, best = handle;
  }
  return best;
}

std::vector<ClipEditor::Setting> TakeCanvas::pulled(const ClipEditor& editor, MotionProperty property, Vec2 to) {
  const Motion& motion = at_frame(editor, editor.frame());
  if (property.kind == Kind::centre_x || property.kind == Kind::centre_y) {
    const Vec2 centre = view_.to_figure(to);
    return {{{Kind::centre_x, 0}, centre.x}, {{Kind::centre_y, 0}, centre.y}};
  }
  return {{property, trial_.value_for(motion, property, to, view_)}};
}

}  // namespace nt
