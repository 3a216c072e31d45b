// SPDX-License-Identifier: Apache-2.0
// The detail mesh by Green coordinates of the tetrahedron around each vertex: [L]'s own embedding (Eq 12).
//
// Input, once: for each slot of an embedding four weights phi of the corners and four psi of the faces
// (app/author/green_coordinates.h). Input, each frame: the lattice's vertices. Output: as embed_linear's.
//   x' = sum_i phi_i v_i' + sum_j psi_j s_j n_j', s_j the stretch of face j (Lipman, Levin, Cohen-Or, "Green coordinates",
//   2008); face j lies opposite to corner j.
// Here for comparison: two tetrahedra give different places for the same point of their common face, so a surface tears
// where they meet, and Phong (embed.h) is nearer to the true warp. Lipman's page says "patent pending" for these coordinates.
// Cost: 60 flops a vertex and 100 a tetrahedron. Memory: none of its own.
#pragma once
#include <cstdint>
#include <span>

#include "core/deform/embed.h"

namespace nt {

// coordinates: 8 floats a slot (four slots a block): phi, then psi. out: 12 floats a block.
void embed_green(const EmbeddingView& embedding, std::span<const float> coordinates, const LatticeView& lattice,
                 std::span<const Vec3> vertices, std::span<float> out);

}  // namespace nt
