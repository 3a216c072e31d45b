// SPDX-License-Identifier: Apache-2.0
// Points in tetrahedra -> Green coordinates. Off the frame path.
//
// Input: a tetrahedron of positive volume, a point inside it. Output: phi of its corners (sum 1), psi of its faces, as
// core/deform/embed_green.h wants them. Source: Lipman, Levin, Cohen-Or, "Green coordinates", 2008, the closed form of its
// Algorithm 1, in double. A point outside, or on a face, where the formulas have no value, is moved towards the middle
// until it is inside; what that moves it by is put back as a shift of phi's corners (barycentric, so linear).
#pragma once
#include <array>
#include <vector>

#include "core/deform/embed.h"

namespace nt {

std::array<double, 8> green_coordinates(const std::array<Vec3, 4>& corners, Vec3 p);

// For every slot of an embedding, 8 floats each.
std::vector<float> green_embedding(const EmbeddingView& embedding, const LatticeView& lattice);

}  // namespace nt
