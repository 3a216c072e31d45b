// SPDX-License-Identifier: Apache-2.0
#include "core/deform/skeleton.h"

#include <algorithm>

namespace nt {
namespace {

Vec3 vertex_at(const float* x, uint16_t i) { return {x[3 * i], x[3 * i + 1], x[3 * i + 2]}; }

// q = swing * twist, the twist about the frame's x axis.
JointAngles split(Quat q, Vec3 x, Vec3 y, Vec3 z) {
  if (q.w < 0.0f) q = {-q.w, -q.x, -q.y, -q.z};
  const float along = dot(axis_part(q), x);
  // Half a turn of swing leaves the twist undefined: none is as good as any.
  const bool defined = q.w * q.w + along * along > 1e-12f;
  const Quat twist = defined ? normalised(Quat{q.w, along * x.x, along * x.y, along * x.z}) : Quat{};
  const Vec3 swing = rotation_vector(q * conjugate(twist));
  return {defined ? 2.0f * det::atan2(along, q.w) : 0.0f, dot(swing, y), dot(swing, z)};
}

}  // namespace

void Skeleton::create(Arena& arena, const SkeletonView& view, std::span<const Vec3> rest) {
  view_ = view;
  const std::size_t n = view.joints();
  frame_ = arena.take<Frame>(n);
  rotation_ = arena.take<Quat>(n);
  direction_ = arena.take<Vec3>(n);
  shift_ = arena.take<Vec3>(n);
  root_ = arena.take<uint16_t>(n);
  members_ = arena.take<uint16_t>(n);
  length_ = arena.take<float>(view.chain.size());
  placed_ = arena.take<Vec3>(view.chain.size());
  if (n > 0 && placed_.size() != view.chain.size()) return;
  if (n == 0 || frame_.empty()) return;
  for (std::size_t j = 0; j < n; ++j) {
    for (uint32_t p = view.chain_start[j] + 1; p < view.chain_start[j + 1]; ++p) {
      length_[p] = length(rest[view.chain[p]] - rest[view.chain[p - 1]]);
    }
    root_[j] = view.parent[j] == kNoJoint ? static_cast<uint16_t>(j) : root_[view.parent[j]];
    if (view.parent[j] != kNoJoint) frame_[j].x = rest[view.vertex[j]] - rest[view.vertex[view.parent[j]]];
    frame_[j].x = normalised(frame_[j].x);
    direction_[j] = frame_[j].x;
    make_frame(j);
  }
}

void Skeleton::make_frame(std::size_t joint) {
  Frame& f = frame_[joint];
  const uint16_t parent = view_.parent[joint];
  const bool has_parent_bone = parent != kNoJoint && view_.parent[parent] != kNoJoint;
  Vec3 z = has_parent_bone ? cross(f.x, frame_[parent].x) : Vec3{};
  if (length(z) < 0.05f && has_parent_bone) {
    // In line: the parent's own z, as far as it is at right angles.
    z = frame_[parent].z - f.x * dot(f.x, frame_[parent].z);
  }
  f.z = length(z) > 0.05f ? normalised(z) : perpendicular_to(f.x);
  f.y = cross(f.z, f.x);
}

Vec3 Skeleton::mean_direction(std::size_t joint, const float* x) const {
  Vec3 sum;
  for (uint32_t p = view_.chain_start[joint] + 1; p < view_.chain_start[joint + 1]; ++p) {
    sum += normalised(vertex_at(x, view_.chain[p]) - vertex_at(x, view_.chain[p - 1]), Vec3{});
  }
  return normalised(sum, direction_[joint]);
}

// The mean turn of the lattice along a bone.
Quat Skeleton::lattice_turn(std::size_t joint, std::span<const Quat4> rotations) const {
  Quat sum{0, 0, 0, 0};
  for (uint32_t p = view_.chain_start[joint]; p < view_.chain_start[joint + 1]; ++p) {
    const uint16_t v = view_.chain[p];
    const Quat q = lane_of(rotations[v / 4], v % 4);
    const float s = dot(sum, q) < 0.0f ? -1.0f : 1.0f;
    sum = {sum.w + s * q.w, sum.x + s * q.x, sum.y + s * q.y, sum.z + s * q.z};
  }
  return normalised(sum);
}

Quat Skeleton::limited(std::size_t joint, Quat turn) const {
  const JointLimits& l = view_.limits[joint];
  const Frame& f = frame_[joint];
  const JointAngles a = split(turn, f.x, f.y, f.z);
  const JointAngles c{det::clamp(a.twist, l.twist_min, l.twist_max), det::clamp(a.y, l.y_min, l.y_max),
                      det::clamp(a.z, l.z_min, l.z_max)};
  if (c.twist == a.twist && c.y == a.y && c.z == a.z) return turn;
  return from_rotation_vector(f.y * c.y + f.z * c.z) * from_rotation_vector(f.x * c.twist);
}

void Skeleton::project(const float* x, std::span<const Quat4> rotations) {
  for (std::size_t j = 0; j < view_.joints(); ++j) {
    const uint16_t parent = view_.parent[j];
    if (parent == kNoJoint) {
      rotation_[j] = lane_of(rotations[view_.vertex[j] / 4], view_.vertex[j] % 4);
      continue;
    }
    const Vec3 d = mean_direction(j, x);
    const Quat around = lattice_turn(j, rotations);
    Quat bone = normalised(shortest_arc(rotate(around, frame_[j].x), d) * around);
    if (view_.limits[j].limited()) {
      bone = normalised(rotation_[parent] * limited(j, conjugate(rotation_[parent]) * bone));
    }
    rotation_[j] = bone;
    direction_[j] = rotate(bone, frame_[j].x);
  }
}

void Skeleton::place(float* x) {
  const std::size_t n = view_.joints();
  std::fill(shift_.begin(), shift_.end(), Vec3{});
  std::fill(members_.begin(), members_.end(), uint16_t{0});
  for (std::size_t j = 0; j < n; ++j) {
    const uint32_t first = view_.chain_start[j], end = view_.chain_start[j + 1];
    if (first == end) continue;
    const uint16_t parent = view_.parent[j];
    const uint32_t parent_end = view_.chain_start[parent + 1u];
    const bool at_root = view_.chain_start[parent] == parent_end;
    placed_[first] = at_root ? vertex_at(x, view_.chain[first]) : placed_[parent_end - 1];
    for (uint32_t p = first + 1; p < end; ++p) {
      placed_[p] = placed_[p - 1] + length_[p] * direction_[j];
      shift_[root_[j]] += vertex_at(x, view_.chain[p]) - placed_[p];
      ++members_[root_[j]];
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    const uint16_t root = root_[j];
    if (members_[root] == 0) continue;
    // The root itself is a member that has not moved.
    const Vec3 shift = shift_[root] * (1.0f / static_cast<float>(members_[root] + 1));
    for (uint32_t p = view_.chain_start[j]; p < view_.chain_start[j + 1]; ++p) {
      const Vec3 at = placed_[p] + shift;
      float* to = x + 3 * view_.chain[p];
      to[0] = at.x, to[1] = at.y, to[2] = at.z;
    }
  }
}

JointAngles Skeleton::angles(std::size_t joint) const {
  const uint16_t parent = view_.parent[joint];
  if (parent == kNoJoint) return {};
  const Frame& f = frame_[joint];
  return split(conjugate(rotation_[parent]) * rotation_[joint], f.x, f.y, f.z);
}

}  // namespace nt
