// SPDX-License-Identifier: Apache-2.0
#include "app/export/rig_joints.h"

#include <algorithm>

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr const char* kFinNames[kMaxFins] = {"l", "r", "l", "r"};

float angle_of(Vec2 v) { return det::atan2(v.y, v.x); }

float distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 ab = b - a;
  const float t = std::clamp(dot(p - a, ab) / std::max(length_sq(ab), 1e-12f), 0.0f, 1.0f);
  return length(p - (a + ab * t));
}

}  // namespace

int Rig::add(const std::string& name, int parent, Vec2 rest) {
  joints_.push_back({name, parent, -1, rest});
  return static_cast<int>(joints_.size()) - 1;
}

// From `first`, at the centre, along the axis to its end.
void Rig::add_chain(const std::string& name, const std::string& end, int count, int first, const Vec2* axis,
                    Vec2 last) {
  int parent = first;
  for (int i = 0; i <= count; ++i) {
    const int joint = add(i < count ? name + std::to_string(i + 1) : end, parent, i < count ? axis[i] : last);
    joints_[static_cast<std::size_t>(parent)].towards = joint;
    parent = joint;
  }
}

int Rig::nearest_bone(Vec2 point) const {
  int best = 0;
  float nearest = 1e30f;
  for (int i = 1; i < spine_; ++i) {
    const RigJoint& joint = joints_[static_cast<std::size_t>(i)];
    if (joint.towards < 0) continue;
    const float distance =
        distance_to_segment(point, joint.rest, joints_[static_cast<std::size_t>(joint.towards)].rest);
    if (distance < nearest) nearest = distance, best = i;
  }
  return best;
}

void Rig::add_fin(int index, const FinPoints& points) {
  const std::string side = kFinNames[index], pair = index >= kSecondLeftFin ? "_2" : "";
  add("jun_t" + side + pair, nearest_bone(points.top), points.top);
  const int bottom = add("jun_b" + side + pair, nearest_bone(points.bottom), points.bottom);
  joints_[static_cast<std::size_t>(bottom)].towards = add(side + "_fin" + pair, bottom, points.tip);
}

Rig::Rig(const Character& character) : u_num_(character.u_num), l_num_(character.l_num) {
  const ControlPoints& c = character.rest;
  const int root = add("centre", -1, c.centre);
  const int front = add("front", root, c.centre);
  add_chain("up_axis_", "head", u_num_, front, c.up_axis, c.head);
  const int back = add("back", root, c.centre);
  add_chain("low_axis_", "tail", l_num_, back, c.low_axis, c.tail);
  spine_ = static_cast<int>(joints_.size());
  for (int i = 0; i < kMaxFins; ++i) {
    if (c.fins[i].present) add_fin(i, c.fins[i]);
  }
  pose_.joints.resize(joints_.size());
}

std::vector<Vec2> Rig::scene_points(const ControlPoints& c) const {
  std::vector<Vec2> points{c.centre, c.centre};
  points.insert(points.end(), c.up_axis, c.up_axis + u_num_);
  points.push_back(c.head), points.push_back(c.centre);
  points.insert(points.end(), c.low_axis, c.low_axis + l_num_);
  points.push_back(c.tail);
  for (const FinPoints& fin : c.fins) {
    if (fin.present) points.push_back(fin.top), points.push_back(fin.bottom), points.push_back(fin.tip);
  }
  return points;
}

Vec2 to_local(const RigPose& pose, float zoom, Vec2 scene) {
  const det::SinCos a = det::sincos(-pose.heading_rad);
  const Vec2 p{(scene.x - pose.centre.x) / zoom, (pose.centre.y - scene.y) / zoom};
  return {p.x * a.cos - p.y * a.sin, p.x * a.sin + p.y * a.cos};
}

const RigPose& Rig::pose(const Retarget& posed, float zoom) {
  const ControlPoints& c = posed.control_points();
  // The line from tail to head in the fish's own frame and on the screen: how far it has turned.
  const std::span<const Vec2> local = posed.handles();
  const Vec2 own = local[1] - local[2], seen = c.head - c.tail;
  const float heading = angle_of({seen.x, -seen.y}) - angle_of(own);
  pose_.heading_rad = posed_ ? det::unwrap(heading, pose_.heading_rad) : det::wrap(heading);
  pose_.centre = c.centre;
  const std::vector<Vec2> points = scene_points(c);
  for (std::size_t i = 0; i < joints_.size(); ++i) pose_.joints[i].at = to_local(pose_, zoom, points[i]);
  // Bones first, then what turns as its parent does; parents come first.
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const RigJoint& joint = joints_[i];
    float& turn = pose_.joints[i].turn_rad;
    if (joint.towards >= 0) {
      const auto to = static_cast<std::size_t>(joint.towards);
      const float now = angle_of(pose_.joints[to].at - pose_.joints[i].at) - angle_of(joints_[to].rest - joint.rest);
      turn = posed_ ? det::unwrap(now, turn) : det::wrap(now);
    } else {
      turn = joint.parent >= 0 ? pose_.joints[static_cast<std::size_t>(joint.parent)].turn_rad : 0.0f;
    }
  }
  posed_ = true;
  return pose_;
}

}  // namespace nt
