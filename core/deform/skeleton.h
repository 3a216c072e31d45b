// SPDX-License-Identifier: Apache-2.0
// The skeleton inside a lattice: straight bones of constant length, and joint limits by swing and twist.
//
// Input: the lattice's vertices (packed x, y, z) and a rotation for each vertex. Output: for each joint the rotation of its bone (world from rest) and
// its direction, within the limits; from these Gamma (core/deform/lattice.h, [L] Eqs 9, 10) and the exact pass.
// Source: [L] IV-C. The direction of a bone is the mean of its edges' directions; lengths are those at rest. The frame of
// a joint at rest is [L]'s: x along the bone, z = x cross the parent's bone, and y = z cross x (its y = x cross z would be
// left-handed). Limits follow Blow, "Inverse kinematics with quaternion joint limits", 2002: the turn of a bone against
// its parent's bone is split into a twist about x and a swing about an axis in the y-z plane; the twist angle and both
// components of the swing's rotation vector are clamped.
// Differs from [L]: (1) its frames come from joint positions alone, so they have no twist where two bones are in line
// (every straight limb); here the twist of a bone is that of the lattice around it, and the shortest arc takes it to the
// bone's direction. (2) A bone is measured against its parent after the parent was corrected, not before: a corrected
// shoulder then does not swing the hand away from its marker.
// Memory: 80 bytes a joint and 16 an entry of the chains. Cost: 0.1 us a bone, 0.3 us a bone with limits.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/vec3.h"
#include "core/deform/lattice_view.h"
#include "core/deform/rotations.h"

namespace nt {

// The turn of a bone against its parent's, radians.
struct JointAngles {
  float twist = 0.0f, y = 0.0f, z = 0.0f;
};

class Skeleton {
 public:
  // The view and the vertices must outlive it.
  void create(Arena& arena, const SkeletonView& view, std::span<const Vec3> rest);

  // The pose nearest to the lattice that has straight bones and keeps the limits. x: 3 floats a vertex.
  void project(const float* x, std::span<const Quat4> rotations);
  // Puts the vertices of all bones where the last `project` has them, with the lengths at rest; each tree keeps its
  // centre. `x` is changed.
  void place(float* x);

  // f(a, b, gamma): the vertices of every edge of every bone, and what x[b] - x[a] should be.
  template <class F>
  void each_edge(F f) const {
    for (std::size_t j = 0; j < view_.joints(); ++j) {
      for (uint32_t p = view_.chain_start[j] + 1; p < view_.chain_start[j + 1]; ++p) {
        f(view_.chain[p - 1], view_.chain[p], length_[p] * direction_[j]);
      }
    }
  }
  std::span<const Quat> rotations() const { return rotation_; }  // world from rest, of each joint's bone
  JointAngles angles(std::size_t joint) const;
  float edge_length(uint32_t chain_entry) const { return length_[chain_entry]; }
  const SkeletonView& view() const { return view_; }

 private:
  struct Frame {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  };
  void make_frame(std::size_t joint);
  Quat lattice_turn(std::size_t joint, std::span<const Quat4> rotations) const;
  Vec3 mean_direction(std::size_t joint, const float* x) const;
  Quat limited(std::size_t joint, Quat turn) const;

  SkeletonView view_;
  std::span<Frame> frame_;  // at rest
  std::span<Quat> rotation_;
  std::span<Vec3> direction_;
  std::span<Vec3> shift_;        // of each root's tree, scratch of `place`
  std::span<uint16_t> root_;     // of each joint
  std::span<uint16_t> members_;  // entries of each root's tree
  std::span<float> length_;      // of the edge that ends in a chain entry
  std::span<Vec3> placed_;       // scratch: a place for each chain entry
};

}  // namespace nt
