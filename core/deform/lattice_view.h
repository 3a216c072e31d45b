// SPDX-License-Identifier: Apache-2.0
// A control lattice at rest, as it lies in a character file: what [L] computes off line (sections IV-A and IV-B).
//
// [L] is Le Naour, Courty, Gibet, "Real-time mesh animation from low dimensional positional constraints".
// Vertices are numbered in the elimination order of the factor, so nothing is permuted at run time, and every index is
// a uint16. Lengths are in the mesh's own unit; weights have none: they are divided by their median.
// A view owns nothing; the spans lie in the mapped file or in the arena of `derive_lattice`.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/base/vec3.h"

namespace nt {

// Which quadratic form the factor is of, see core/deform/lattice.h. The stacked form has a larger pattern.
enum class LatticeForm : uint8_t { arap, stacked };

// A point of the character that a marker pulls at: a weighted mean of the corners of one tetrahedron. A marker that is
// a lattice vertex has weight 1 there.
struct MarkerBinding {
  uint16_t vertex[4] = {};
  float weight[4] = {1.0f, 0.0f, 0.0f, 0.0f};
};

inline constexpr uint16_t kNoJoint = 0xffff;

// How far a joint may turn from its rest pose, radians: twist about the bone that ends in it, swing about the other two
// axes of [L]'s frame (core/deform/skeleton.h).
struct JointLimits {
  float twist_min = -det::kPi, twist_max = det::kPi;
  float y_min = -det::kPi, y_max = det::kPi;
  float z_min = -det::kPi, z_max = det::kPi;
  bool limited() const {
    const float all = 3.14159f;
    return twist_min > -all || twist_max < all || y_min > -all || y_max < all || z_min > -all || z_max < all;
  }
};

// Joints, parents before children. The bone of joint j runs from its parent to j along the lattice vertices
// chain[chain_start[j]] .. chain[chain_start[j + 1] - 1], both ends included; a root has an empty chain.
// The limits of joint j bound the turn of its bone against its parent's bone (for the bones of a root: against the
// lattice around the root).
struct SkeletonView {
  std::span<const uint16_t> vertex;       // [joints], lattice vertex
  std::span<const uint16_t> parent;       // [joints], kNoJoint for a root
  std::span<const uint32_t> chain_start;  // [joints + 1]
  std::span<const uint16_t> chain;
  std::span<const JointLimits> limits;  // [joints]
  std::size_t joints() const { return vertex.size(); }
};

struct LatticeView {
  LatticeForm form = LatticeForm::arap;
  std::span<const Vec3> vertices;
  std::span<const uint16_t> tetrahedra;       // 4 each, positive volume
  std::span<const uint32_t> neighbour_start;  // [vertices + 1]
  std::span<const uint16_t> neighbours;       // of each vertex, rising
  std::span<const float> weights;             // of each neighbour, Eq 8, clamped
  std::span<const uint32_t> column_start;     // [vertices + 1], strictly lower part of the factor
  std::span<const uint16_t> rows;             // of each column, rising
  std::span<const MarkerBinding> markers;
  SkeletonView skeleton;
};

// Six times the volume, positive if d lies on the side of abc that the right-hand rule a, b, c points to.
inline float volume6(Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(cross(b - a, c - a), d - a); }

// The order of least fill-in (core/deform/elimination_order.h): place[k] = the vertex that is eliminated k-th.
// Scratch: 3/8 vertices^2 bytes. Off the frame path.
bool elimination_order(Arena& scratch, std::size_t vertices, std::span<const uint16_t> tetrahedra, LatticeForm form,
                       std::span<uint16_t> place);

// Everything of a view that follows from vertices and tetrahedra in elimination order: neighbours, weights, pattern.
// Weights: w_ij = 1/6 sum_k l_k cot alpha_k (Eq 8), clamped to [0.05, 20] times the median of their magnitude and
// divided by it. [L] keeps the negative ones; with a rotation for each vertex these diverge, so they are clamped.
// The result lies in `out`; bad_data for a tetrahedron without volume or an index out of range.
Result<LatticeView> derive_lattice(Arena& out, Arena& scratch, std::span<const Vec3> vertices,
                                   std::span<const uint16_t> tetrahedra, LatticeForm form);

// Checks every index and count of a view that came from a file, so that the solver may trust it.
Status check_lattice(const LatticeView& view, const Limits& limits);

}  // namespace nt
