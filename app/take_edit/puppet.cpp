// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/puppet.h"

#include <algorithm>
#include <cmath>

#include "core/base/det_math.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

constexpr float kCourseShare = 0.62f;  // of the length: how far ahead of the centre the course's handle lies
constexpr float kStep_rad = 0.02f, kLongestStep_rad = 0.6f, kNear_rad = 1e-3f;
constexpr int kSteps = 6;
constexpr float kNearer_px = 0.02f;
// Where that leads nowhere, from a fin that is open farther than the drawing's can be, values all around are tried.
constexpr float kStill_px = 0.5f;  // a radian
constexpr float kClose_px = 1;
constexpr float kSearch_rad = 2.4f;
constexpr int kSearched = 24;

// Of `to` joints the one that lies where joint `index` of `from` does.
int matching_joint(int index, int from, int to) {
  const float along = static_cast<float>(index + 1) / static_cast<float>(from);
  return std::max(static_cast<int>(std::lround(along * static_cast<float>(to))) - 1, 0);
}

}  // namespace

Puppet::Puppet(const Wardrobe& wardrobe, float init_len_px) : wardrobe_(&wardrobe), init_len_px_(init_len_px) {
  Arena measuring;
  (void)wardrobe.fitting(0, measuring);
  memory_ = AlignedBlock(measuring.used());
  Arena arena(memory_.bytes());
  retarget_ = wardrobe.fitting(0, arena);
  retarget_->start(init_len_px);
}

void Puppet::pose(const Motion& motion, const FigureView& view) {
  Placement placement;
  placement.zoom = view.scale * init_len_px_ / retarget_->lengths().body_len;
  placement.offset = view.to_scene({0, 0});
  retarget_->pose(motion, 0, placement);
  motion_ = motion;
  scale_ = view.scale;
}

Vec2 Puppet::handle_at(MotionProperty property) const {
  const ControlPoints& c = retarget_->control_points();
  const Character& worn = character();
  const auto joint = [&](int bones, int joints) {
    return static_cast<std::size_t>(matching_joint(property.index, bones, joints));
  };
  switch (property.kind) {
    case Kind::head:
      return c.head;
    case Kind::tail:
      return c.tail;
    case Kind::up_axis:
      return c.up_axis[joint(motion_.u_num, worn.u_num)];
    case Kind::low_axis:
      return c.low_axis[joint(motion_.l_num, worn.l_num)];
    case Kind::l_fin:
      return c.fins[kLeftFin].tip;
    case Kind::r_fin:
      return c.fins[kRightFin].tip;
    case Kind::dir: {
      const det::SinCos course = det::sincos(motion_.dir_rad);
      return c.centre + Vec2{course.cos, course.sin} * (kCourseShare * init_len_px_ * scale_);
    }
    case Kind::centre_x:
    case Kind::centre_y:
      break;
  }
  return c.centre;
}

std::vector<Handle> Puppet::handles() const {
  std::vector<MotionProperty> properties;
  const Character& worn = character();
  for (int i = 0; i < worn.u_num; ++i)
    properties.push_back({Kind::up_axis, matching_joint(i, worn.u_num, motion_.u_num)});
  for (int i = 0; i < worn.l_num; ++i)
    properties.push_back({Kind::low_axis, matching_joint(i, worn.l_num, motion_.l_num)});
  properties.insert(properties.end(), {{Kind::head, 0}, {Kind::tail, 0}, {Kind::dir, 0}, {Kind::centre_x, 0}});
  const ControlPoints& c = retarget_->control_points();
  if (c.fins[kLeftFin].present) properties.push_back({Kind::l_fin, 0});
  if (c.fins[kRightFin].present) properties.push_back({Kind::r_fin, 0});
  std::vector<Handle> handles;
  for (const MotionProperty property : properties) handles.push_back({property, handle_at(property)});
  return handles;
}

float Puppet::course_towards(const Motion& motion, Vec2 at, const FigureView& view) const {
  const Vec2 away = view.to_figure(at) - motion.centre;
  if (length_sq(away) == 0) return motion.dir_rad;
  return motion.dir_rad + det::wrap(det::atan2(away.y, away.x) - motion.dir_rad);
}

Vec2 Puppet::with_value(Motion& motion, MotionProperty property, float value, const FigureView& view) {
  set_value(motion, property, value);
  pose(motion, view);
  return handle_at(property);
}

float Puppet::value_for(Motion motion, MotionProperty property, Vec2 pulled_to, const FigureView& view) {
  if (property.kind == Kind::dir) return course_towards(motion, pulled_to, view);
  const float start = value_of(motion, property);
  float best = start, nearest = length(pulled_to - with_value(motion, property, start, view));
  // A value is taken only where it brings the handle nearer: a fin at its limit looks the same wherever beyond it is.
  const auto consider = [&](float value) {
    const float far = length(pulled_to - with_value(motion, property, value, view));
    if (far < nearest - kNearer_px) nearest = far, best = value;
  };
  for (int i = 0; i < kSteps; ++i) {
    const Vec2 before = with_value(motion, property, best - kStep_rad, view);
    const Vec2 after = with_value(motion, property, best + kStep_rad, view);
    const Vec2 slope = (after - before) * (0.5f / kStep_rad);
    if (length_sq(slope) < kStill_px * kStill_px) break;
    const Vec2 missing = pulled_to - (before + after) * 0.5f;
    const float step = std::clamp(dot(slope, missing) / length_sq(slope), -kLongestStep_rad, kLongestStep_rad);
    const float from = best;
    consider(from + step);
    if (best == from || std::abs(step) < kNear_rad) break;
  }
  if (best != start || nearest < kClose_px) return best;
  for (int k = 1; k <= kSearched; ++k)
    for (const float side : {-1.0f, 1.0f}) consider(start + side * kSearch_rad * static_cast<float>(k) / kSearched);
  return best;
}

}  // namespace nt
