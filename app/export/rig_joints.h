// SPDX-License-Identifier: Apache-2.0
// A character's control points as a tree of joints, at rest and in a pose: what a skinned file is animated by.
//
// Joints: `centre`, the root, turns with the fish; `front` and `back` lie there too and turn the first bones; then
// up_axis_1 .. head and low_axis_1 .. tail, and of each fin jun_tl and jun_bl (junctions at the head's side and the
// tail's) and its tip l_fin; right ones likewise, the second pair ends in _2. A joint turns with the bone to the joint
// that follows it; one that ends a chain, and a fin's front junction, turns with its parent. The fin turns about its
// rear junction, as Retarget has it. Parents come before their children.
// Frame of reference: character units and axes (x right, y ahead). Cost: an arc tangent a joint.
#pragma once
#include <string>
#include <vector>

#include "core/character/retarget.h"

namespace nt {

struct RigJoint {
  std::string name;
  int parent = -1;
  int towards = -1;  // the joint that the bone from here leads to; -1: turns as the parent does
  Vec2 rest;
};

struct JointPose {
  Vec2 at;             // character units, fish-local frame
  float turn_rad = 0;  // against rest, anticlockwise, in that frame
};

struct RigPose {
  Vec2 centre;            // scene pixels, y down
  float heading_rad = 0;  // of the character's y against straight up the screen, anticlockwise as it is seen
  std::vector<JointPose> joints;
};

class Rig {
 public:
  explicit Rig(const Character& character);
  const std::vector<RigJoint>& joints() const { return joints_; }
  // Where the control points are, a point a joint in their order.
  std::vector<Vec2> scene_points(const ControlPoints& points) const;
  // Turns are continuous from call to call. `zoom`: scene pixels a character unit, as it was posed.
  const RigPose& pose(const Retarget& posed, float zoom);

 private:
  int add(const std::string& name, int parent, Vec2 rest);
  void add_chain(const std::string& name, const std::string& end, int count, int first, const Vec2* axis, Vec2 last);
  void add_fin(int index, const FinPoints& points);
  int nearest_bone(Vec2 point) const;

  int u_num_, l_num_, spine_ = 0;
  std::vector<RigJoint> joints_;
  RigPose pose_;
  bool posed_ = false;
};

// A point of the scene in the frame of the rig's joints.
Vec2 to_local(const RigPose& pose, float zoom, Vec2 scene);

}  // namespace nt
