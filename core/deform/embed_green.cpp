// SPDX-License-Identifier: Apache-2.0
#include "core/deform/embed_green.h"

namespace nt {
namespace {

// Of corner j the face opposite to it, seen from outside anticlockwise in a tetrahedron of positive volume.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// The stretch of a face times its normal.
Vec3 stretched_normal(const Vec3 (&rest)[4], const Vec3 (&now)[4], const int (&face)[3]) {
  const Vec3 u = rest[face[1]] - rest[face[0]], v = rest[face[2]] - rest[face[0]];
  const Vec3 p = now[face[1]] - now[face[0]], q = now[face[2]] - now[face[0]];
  const float area2 = length(cross(u, v));  // twice the face's area
  const float square = length_sq(p) * length_sq(v) - 2.0f * dot(p, q) * dot(u, v) + length_sq(q) * length_sq(u);
  const float stretch = area2 > 0.0f ? det::sqrt(det::max(square, 0.0f)) / (1.41421356f * area2) : 0.0f;
  return stretch * normalised(cross(p, q), Vec3{});
}

}  // namespace

void embed_green(const EmbeddingView& e, std::span<const float> coordinates, const LatticeView& lattice,
                 std::span<const Vec3> vertices, std::span<float> out) {
  Vec3 now[4], side[4];
  uint32_t last = 0xffffffffu;
  for (std::size_t k = 0; k < e.blocks(); ++k) {
    if (e.tetrahedron[k] != last) {
      last = e.tetrahedron[k];
      const uint16_t* corner = &lattice.tetrahedra[4u * last];
      Vec3 rest[4];
      for (int i = 0; i < 4; ++i) rest[i] = lattice.vertices[corner[i]], now[i] = vertices[corner[i]];
      for (int j = 0; j < 4; ++j) side[j] = stretched_normal(rest, now, kFaces[j]);
    }
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const float* c = &coordinates[8 * (4 * k + lane)];
      Vec3 p;
      for (int i = 0; i < 4; ++i) p += c[i] * now[i] + c[4 + i] * side[i];
      float* to = &out[12 * k + 3 * lane];
      to[0] = p.x, to[1] = p.y, to[2] = p.z;
    }
  }
}

}  // namespace nt
