// SPDX-License-Identifier: Apache-2.0
// The rotation that brings a vertex' rest edges nearest to its moved ones ([L] Eq 5), for four vertices at a time.
//
// Input: S = sum_j w_j e_j e'_j^T of each vertex, e at rest and e' moved, and the rotation of the frame before.
// Output: R that maximises tr(R S), that is, minimises sum w |e' - R e|^2.
// Newton on SO(3): with K = R S, a turn by omega changes tr(R S) by g . omega - 1/2 omega^T B omega, where
// g = (K_yz - K_zy, K_zx - K_xz, K_xy - K_yx) and B = tr(K) I - sym(K); omega = B^-1 g. Two steps from the last frame's
// rotation are exact to float where the turn since then is below about 60 degrees, and one where it is below 0.2: the error is of the third order. Where B is not positive or the last
// step was still long, the closed form takes over: Horn's 4x4 quaternion matrix ("Closed-form solution of absolute
// orientation using unit quaternions", 1987), by Jacobi's method, which also never gives a reflection.
// Differs from [L], which takes an SVD of every S: 20 us in place of 450 for 1,000 vertices.
#pragma once
#include "core/base/float4.h"

namespace nt {

// Four rotations, one a lane.
struct Quat4 {
  Float4 w, x, y, z;
};
// Four 3x3 matrices, m[3 * row + column], one a lane.
struct Matrix4x {
  Float4 m[9];
};

Matrix4x matrices(const Quat4& q);

// One Newton step or `steps` of them. Returns true if a lane may not have converged: then call `best_rotation` for it.
bool newton_rotations(const Matrix4x& s, int steps, Quat4& q);

// The maximiser of tr(R S) from scratch; s[3 * row + column]. Bounded: 12 Jacobi sweeps at most.
Quat best_rotation(const float s[9]);

inline Quat lane_of(const Quat4& q, int lane) { return {q.w[lane], q.x[lane], q.y[lane], q.z[lane]}; }
inline void set_lane(Quat4& q, int lane, Quat v) { q.w[lane] = v.w, q.x[lane] = v.x, q.y[lane] = v.y, q.z[lane] = v.z; }

}  // namespace nt
