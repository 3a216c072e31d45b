// SPDX-License-Identifier: Apache-2.0
// The detail mesh inside a control lattice: lattice vertices -> detail vertices.
//
// Input, once: for each detail vertex its tetrahedron and barycentric coordinates at rest. Input, each frame: the
// lattice's vertices. Output: x, y, z of each detail vertex, ready for a vertex buffer.
// Layout: detail vertices are sorted by tetrahedron and cut into blocks of four that share one, so that four are worked on
// at once with the tetrahedron's coefficients in registers; a last block of a tetrahedron is filled up with copies.
//   linear  x' = sum b_i x_i'
//   Phong   x' = sum b_i x_i' + sum_i<j b_i b_j 1/2 (F_i - F_j) (X_j - X_i): James, "Phong deformation: a better C0
//           interpolant for embedded deformation", 2020. Continuous across faces; exact for quadratic fields where F is.
// Differs from James: F_i, the deformation gradient at a lattice vertex, is the least-squares fit to its edges with the
// lattice's own weights in place of the mean over its tetrahedra; this needs 24 bytes a vertex and no inverse a tetrahedron.
// Differs from [L], which embeds by Green coordinates of each tetrahedron (Eq 12): these jump at the faces between them.
// Memory: Phong 76 bytes a lattice vertex, 12 a neighbour and 12 a tetrahedron; linear none.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/float4.h"
#include "core/deform/lattice_view.h"

namespace nt {

struct EmbeddingView {
  // Of four detail vertices: b1[4], b2[4], b3[4], the weights of the tetrahedron's corners 1 to 3; b0 = 1 - b1 - b2 - b3.
  std::span<const float> coordinates;     // [12 * blocks]
  std::span<const uint16_t> tetrahedron;  // [blocks], never falling
  std::size_t blocks() const { return tetrahedron.size(); }
};

Status check_embedding(const EmbeddingView& embedding, const LatticeView& lattice);

// out: 12 floats a block, x y z of four vertices.
void embed_linear(const EmbeddingView& embedding, const LatticeView& lattice, std::span<const Vec3> vertices,
                  std::span<float> out);

class PhongEmbedding {
 public:
  // Null when the arena is measuring or full. Both views must outlive it.
  static PhongEmbedding* create(Arena& arena, const EmbeddingView& embedding, const LatticeView& lattice);
  void embed(std::span<const Vec3> vertices, std::span<float> out);
  // What a vertex shader needs to do the same: for each lattice vertex its place and the columns of F, 12 floats.
  void pack(std::span<const Vec3> vertices, std::span<float> out);

 private:
  struct Inverse {  // of sum w e e^T: symmetric
    float xx, xy, xz, yy, yz, zz;
  };
  void fit_gradients(std::span<const Vec3> vertices);
  void bend_edges();

  EmbeddingView embedding_;
  LatticeView lattice_;
  std::span<Inverse> inverse_;
  std::span<float> gradient_;    // columns of F, nine a vertex and a tail
  std::span<float> bend_;        // 1/2 (F_i - F_j)(X_j - X_i), three a neighbour and a tail; where i < j
  std::span<uint16_t> edge_of_;  // six a tetrahedron
};

}  // namespace nt
