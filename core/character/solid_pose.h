// SPDX-License-Identifier: Apache-2.0
// The heights and the normals of a 3D character's vertices, which moving least squares in the plane leaves open.
//
// Rest heights and normals (character units and axes) + the body's control points as posed -> heights in scene pixels, and
// normals with scene axes (x right, y down, z towards the viewer), not quite of unit length. Heights are kept as they are
// (METHOD section 4: z is kept under MLS); a normal turns in the plane with the bone of the body nearest to its vertex,
// blended with the next one. Fins' own turns are not followed: their normals point up and down.
// Memory: 20 bytes per vertex. Cost: 20 flops per vertex, 0.02 ms for 6,000. A flat character takes neither.
#pragma once
#include <span>

#include "core/base/arena.h"
#include "core/character/character.h"
#include "core/character/lattice_pose.h"

namespace nt {

class SolidPose {
 public:
  // `body`: centre, head, tail, up_axis, low_axis at rest, as Retarget orders them.
  void create(Arena& arena, const Character& character, std::span<const Vec2> body);
  // Another one that shares what `of` has found, with a pose of its own.
  void twin(Arena& arena, const SolidPose& of);

  // `up`: the scene's direction of the character's y, as long as one character unit is there.
  void pose(std::span<const Vec2> body, Vec2 up);

  // The same from a lattice, which knows them.
  void take(const LatticePose& lattice, Vec2 up);

  std::span<const float> heights() const { return heights_; }
  std::span<const Vec3> normals() const { return normals_; }

 private:
  static constexpr int kMaxJoints = 3 + kMaxUpAxis + kMaxLowAxis;
  // The chain from head to tail; returns the number of its joints.
  int chain(std::span<const Vec2> body, Vec2* joints) const;

  int u_num_ = 0, l_num_ = 0;
  std::span<const float> rest_heights_;
  std::span<const Vec3> rest_normals_;
  std::span<const float>
      place_;  // per vertex: bones before the nearest point of the chain at rest, and the share of its own
  Vec2 rest_bones_[kMaxJoints];  // unit
  std::span<float> heights_;
  std::span<Vec3> normals_;
};

}  // namespace nt
