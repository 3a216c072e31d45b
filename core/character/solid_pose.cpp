// SPDX-License-Identifier: Apache-2.0
#include "core/character/solid_pose.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

// Where on the chain v is nearest: bones before it, and the share of that bone.
float nearest_place(Vec2 v, const Vec2* joints, int bones) {
  float best = 0, best_sq = -1;
  for (int k = 0; k < bones; ++k) {
    const Vec2 bone = joints[k + 1] - joints[k];
    const float len_sq = length_sq(bone);
    const float t = len_sq > 0.0f ? det::clamp(dot(v - joints[k], bone) / len_sq, 0.0f, 1.0f) : 0.0f;
    const float d = length_sq(v - (joints[k] + bone * t));
    if (best_sq >= 0.0f && d >= best_sq) continue;
    best_sq = d;
    best = static_cast<float>(k) + t;
  }
  return best;
}

}  // namespace

int SolidPose::chain(std::span<const Vec2> body, Vec2* joints) const {
  const auto at = [&](int i) { return body[static_cast<std::size_t>(i)]; };
  int n = 0;
  joints[n++] = at(1);
  for (int i = u_num_ - 1; i >= 0; --i) joints[n++] = at(3 + i);
  joints[n++] = at(0);
  for (int i = 0; i < l_num_; ++i) joints[n++] = at(3 + u_num_ + i);
  joints[n++] = at(2);
  return n;
}

void SolidPose::create(Arena& arena, const Character& character, std::span<const Vec2> body) {
  if (!character.solid()) return;
  u_num_ = character.u_num, l_num_ = character.l_num;
  rest_heights_ = character.heights;
  rest_normals_ = character.normals;
  const std::span<float> place = arena.take<float>(character.heights.size());
  place_ = place;
  heights_ = arena.take<float>(character.heights.size());
  normals_ = arena.take<Vec3>(character.heights.size());
  if (arena.measuring() || arena.full()) return;
  Vec2 joints[kMaxJoints];
  const int bones = chain(body, joints) - 1;
  for (int k = 0; k < bones; ++k) rest_bones_[k] = normalised(joints[k + 1] - joints[k]);
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = nearest_place(character.vertices[v], joints, bones);
}

void SolidPose::twin(Arena& arena, const SolidPose& of) {
  *this = of;
  heights_ = arena.take<float>(of.heights_.size());
  normals_ = arena.take<Vec3>(of.normals_.size());
}

void SolidPose::pose(std::span<const Vec2> body, Vec2 up) {
  if (heights_.empty()) return;
  const float zoom = length(up);
  const Vec2 unit_up = normalised(up), unit_right = right_of(unit_up);
  Vec2 joints[kMaxJoints], turn[kMaxJoints];  // turn: cosine and sine, by bone
  const int bones = chain(body, joints) - 1;
  for (int k = 0; k < bones; ++k) {
    const Vec2 bone = normalised(joints[k + 1] - joints[k]);
    turn[k] = {dot(rest_bones_[k], bone), cross(rest_bones_[k], bone)};
  }
  for (std::size_t v = 0; v < heights_.size(); ++v) {
    heights_[v] = rest_heights_[v] * zoom;
    const float s = det::clamp(place_[v] - 0.5f, 0.0f, static_cast<float>(bones - 1));
    const int k = static_cast<int>(s), next = k + 1 < bones ? k + 1 : k;
    const Vec2 a = lerp(turn[k], turn[next], s - static_cast<float>(k));
    const Vec3 n = rest_normals_[v];
    const float x = n.x * a.x - n.y * a.y, y = n.x * a.y + n.y * a.x;
    normals_[v] = {unit_right.x * x + unit_up.x * y, unit_right.y * x + unit_up.y * y, n.z};
  }
}

void SolidPose::take(const LatticePose& lattice, Vec2 up) {
  const float zoom = length(up);
  const Vec2 unit_up = normalised(up), unit_right = right_of(unit_up);
  for (std::size_t v = 0; v < heights_.size(); ++v) {
    heights_[v] = lattice.place(v).z * zoom;
    const Vec3 n = lattice.normal(v);
    normals_[v] = {unit_right.x * n.x + unit_up.x * n.y, unit_right.y * n.x + unit_up.y * n.y, n.z};
  }
}

}  // namespace nt
