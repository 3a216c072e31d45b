// SPDX-License-Identifier: Apache-2.0
// Skin weights under which joints move the vertices as nearly as they can to where our own deformation puts them.
//
// Rest positions of vertices and joints, and samples of joints and vertices in motion -> kInfluences joints and weights a
// vertex, weights >= 0 with sum 1, none twice, a weight of 0 with joint 0. Any one frame of reference and unit.
// Method: with a_j = T_j v - v' (joint j alone, against the vertex wanted) the squared error of weights w is w' A'A w, A
// the a_j of all samples side by side; minimised on the simplex by pairwise steps, then again with the strongest four.
// A little distance is added to each joint's own cost, so that where the samples leave a choice the nearest joint takes it.
// Source: the least-squares fit of James and Twigg, "Skinning mesh animations", 2005, section 4.2, with the joints given.
// Cost: vertices x samples x joints^2 flops: 1 s for 2,500 vertices, 120 samples and 30 joints.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "app/export/rig_joints.h"

namespace nt {

inline constexpr std::size_t kInfluences = 4;  // what every reader of glTF supports

struct SkinVertex {
  std::array<uint16_t, kInfluences> joints{};
  std::array<float, kInfluences> weights{};
};

struct SkinSample {
  std::vector<JointPose> joints;
  std::vector<Vec2> vertices;
};

// `length`: of the body, the unit in which distances count. `before`: the last fit, whose greatest errors are to shrink.
std::vector<SkinVertex> fit_skin(std::span<const Vec2> vertices, std::span<const RigJoint> joints,
                                 std::span<const SkinSample> samples, float length,
                                 std::span<const SkinVertex> before = {});

// A vertex whose neighbour's weights (three indices a triangle) leave it nearer in its worst sample takes those.
void share_with_neighbours(std::span<SkinVertex> skin, std::span<const uint32_t> triangles,
                           std::span<const Vec2> vertices, std::span<const RigJoint> joints,
                           std::span<const SkinSample> samples);

// Turns each joint, where it is, so that the skin comes nearest to `wanted`: joint by joint against what the others leave,
// kTurnRounds times, from its bone's turn and held to it a little. The root keeps its own. Cost: vertices x influences x kTurnRounds.
inline constexpr int kTurnRounds = 12;
void fit_turns(std::span<const SkinVertex> skin, std::span<const Vec2> vertices, std::span<const Vec2> wanted,
               std::span<const RigJoint> joints, float length, std::span<JointPose> pose);

// Where the skin puts a vertex.
Vec2 skinned(const SkinVertex& skin, Vec2 rest, std::span<const RigJoint> joints, std::span<const JointPose> pose);

}  // namespace nt
