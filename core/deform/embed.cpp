// SPDX-License-Identifier: Apache-2.0
#include "core/deform/embed.h"

#include <algorithm>
#include <new>

namespace nt {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// x, y, z of four vertices as they lie in a vertex buffer.
void store_interleaved(float* to, Float4 x, Float4 y, Float4 z) {
  const Float4 xy01 = shuffle4<0, 4, 1, 5>(x, y), xy23 = shuffle4<2, 6, 3, 7>(x, y);
  const Float4 zx01 = shuffle4<0, 5, 0, 5>(z, x), yz11 = shuffle4<1, 5, 1, 5>(y, z);
  const Float4 zx23 = shuffle4<2, 7, 2, 7>(z, x), yz33 = shuffle4<3, 7, 3, 7>(y, z);
  store4(to, shuffle4<0, 1, 4, 5>(xy01, zx01));
  store4(to + 4, shuffle4<0, 1, 4, 5>(yz11, xy23));
  store4(to + 8, shuffle4<0, 1, 4, 5>(zx23, yz33));
}

// x' = corner 0 + b1 side 1 + b2 side 2 + b3 side 3, each value in all four lanes.
struct Sides {
  Float4 corner[3], side[3][3];
};

void fill(Sides& s, const uint16_t* tet, std::span<const Vec3> x) {
  const Vec3 a = x[tet[0]];
  const float corner[3] = {a.x, a.y, a.z};
  for (int c = 0; c < 3; ++c) s.corner[c] = splat4(corner[c]);
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = x[tet[k + 1]] - a;
    s.side[k][0] = splat4(d.x), s.side[k][1] = splat4(d.y), s.side[k][2] = splat4(d.z);
  }
}

Float4 linear(const Sides& s, int c, Float4 b1, Float4 b2, Float4 b3) {
  return (s.corner[c] + b1 * s.side[0][c]) + (b2 * s.side[1][c] + b3 * s.side[2][c]);
}

}  // namespace

Status check_embedding(const EmbeddingView& e, const LatticeView& lattice) {
  const Status bad{StatusCode::bad_data, "the embedding of the detail mesh is damaged"};
  if (e.coordinates.size() != 12 * e.blocks()) return bad;
  for (std::size_t k = 0; k < e.blocks(); ++k) {
    if (4u * e.tetrahedron[k] + 3u >= lattice.tetrahedra.size() || (k > 0 && e.tetrahedron[k] < e.tetrahedron[k - 1])) {
      return bad;
    }
  }
  for (const float b : e.coordinates) {
    if (!(det::abs(b) < 1e4f)) return bad;
  }
  return {};
}

void embed_linear(const EmbeddingView& e, const LatticeView& lattice, std::span<const Vec3> vertices,
                  std::span<float> out) {
  const float* b = e.coordinates.data();
  float* to = out.data();
  for (std::size_t k = 0; k < e.blocks();) {
    const uint16_t tet = e.tetrahedron[k];
    Sides s;
    fill(s, &lattice.tetrahedra[4u * tet], vertices);
    for (; k < e.blocks() && e.tetrahedron[k] == tet; ++k, b += 12, to += 12) {
      const Float4 b1 = load4(b), b2 = load4(b + 4), b3 = load4(b + 8);
      store_interleaved(to, linear(s, 0, b1, b2, b3), linear(s, 1, b1, b2, b3), linear(s, 2, b1, b2, b3));
    }
  }
}

PhongEmbedding* PhongEmbedding::create(Arena& arena, const EmbeddingView& embedding, const LatticeView& lattice) {
  const auto memory = arena.take<std::byte>(sizeof(PhongEmbedding));
  const std::size_t n = lattice.vertices.size(), tets = lattice.tetrahedra.size() / 4;
  const auto inverse = arena.take<Inverse>(n);
  const auto gradient = arena.take<float>(9 * n + 4);
  const auto bend = arena.take<float>(3 * lattice.neighbours.size() + 4);
  const auto edge_of = arena.take<uint16_t>(6 * tets);
  if (arena.measuring() || arena.full()) return nullptr;
  auto* p = new (memory.data()) PhongEmbedding;
  p->embedding_ = embedding, p->lattice_ = lattice;
  p->inverse_ = inverse, p->gradient_ = gradient, p->bend_ = bend, p->edge_of_ = edge_of;
  for (std::size_t i = 0; i < n; ++i) {
    double m[6] = {};
    for (uint32_t q = lattice.neighbour_start[i]; q < lattice.neighbour_start[i + 1]; ++q) {
      const Vec3 d = lattice.vertices[i] - lattice.vertices[lattice.neighbours[q]];
      const double w = lattice.weights[q], x = d.x, y = d.y, z = d.z;
      m[0] += w * x * x, m[1] += w * x * y, m[2] += w * x * z, m[3] += w * y * y, m[4] += w * y * z, m[5] += w * z * z;
    }
    const double cxx = m[3] * m[5] - m[4] * m[4], cxy = m[2] * m[4] - m[1] * m[5], cxz = m[1] * m[4] - m[2] * m[3];
    const double det = m[0] * cxx + m[1] * cxy + m[2] * cxz, f = det != 0.0 ? 1.0 / det : 0.0;
    const auto as_float = [&](double v) { return static_cast<float>(v * f); };
    inverse[i] = {as_float(cxx),
                  as_float(cxy),
                  as_float(cxz),
                  as_float(m[0] * m[5] - m[2] * m[2]),
                  as_float(m[1] * m[2] - m[0] * m[4]),
                  as_float(m[0] * m[3] - m[1] * m[1])};
  }
  for (std::size_t t = 0; t < tets; ++t) {
    for (std::size_t k = 0; k < 6; ++k) {
      const uint16_t a = lattice.tetrahedra[4 * t + kEdges[k][0]], b = lattice.tetrahedra[4 * t + kEdges[k][1]];
      const uint16_t low = std::min(a, b), high = std::max(a, b);
      const auto first = lattice.neighbours.begin() + lattice.neighbour_start[low];
      const auto last = lattice.neighbours.begin() + lattice.neighbour_start[low + 1u];
      edge_of[6 * t + k] = static_cast<uint16_t>(std::lower_bound(first, last, high) - lattice.neighbours.begin());
    }
  }
  return p;
}

// F_i = (sum w e' e^T) (sum w e e^T)^-1.
void PhongEmbedding::fit_gradients(std::span<const Vec3> x) {
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    Float4 sx = splat4(0.0f), sy = sx, sz = sx;
    for (uint32_t q = lattice_.neighbour_start[i]; q < lattice_.neighbour_start[i + 1]; ++q) {
      const uint16_t j = lattice_.neighbours[q];
      const Vec3 rest = lattice_.weights[q] * (lattice_.vertices[i] - lattice_.vertices[j]);
      const Float4 moved = to4(x[i] - x[j]);
      sx += splat4(rest.x) * moved, sy += splat4(rest.y) * moved, sz += splat4(rest.z) * moved;
    }
    const Inverse& m = inverse_[i];
    store4(&gradient_[9 * i], splat4(m.xx) * sx + splat4(m.xy) * sy + splat4(m.xz) * sz);
    store4(&gradient_[9 * i + 3], splat4(m.xy) * sx + splat4(m.yy) * sy + splat4(m.yz) * sz);
    store4(&gradient_[9 * i + 6], splat4(m.xz) * sx + splat4(m.yz) * sy + splat4(m.zz) * sz);
  }
}

void PhongEmbedding::bend_edges() {
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    const float* f = &gradient_[9 * i];
    for (uint32_t q = lattice_.neighbour_start[i]; q < lattice_.neighbour_start[i + 1]; ++q) {
      const uint16_t j = lattice_.neighbours[q];
      if (j < i) continue;
      const float* g = &gradient_[9u * j];
      const Vec3 d = 0.5f * (lattice_.vertices[j] - lattice_.vertices[i]);
      const Float4 bend = splat4(d.x) * (load4(f) - load4(g)) + splat4(d.y) * (load4(f + 3) - load4(g + 3)) +
                          splat4(d.z) * (load4(f + 6) - load4(g + 6));
      float* to = &bend_[3 * q];
      to[0] = bend[0], to[1] = bend[1], to[2] = bend[2];
    }
  }
}

void PhongEmbedding::pack(std::span<const Vec3> vertices, std::span<float> out) {
  fit_gradients(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    float* to = &out[12 * i];
    to[0] = vertices[i].x, to[1] = vertices[i].y, to[2] = vertices[i].z;
    for (std::size_t k = 0; k < 9; ++k) to[3 + k] = gradient_[9 * i + k];
  }
}

void PhongEmbedding::embed(std::span<const Vec3> vertices, std::span<float> out) {
  fit_gradients(vertices);
  bend_edges();
  const EmbeddingView& e = embedding_;
  const float* b = e.coordinates.data();
  float* to = out.data();
  for (std::size_t k = 0; k < e.blocks();) {
    const uint16_t tet = e.tetrahedron[k];
    Sides s;
    fill(s, &lattice_.tetrahedra[4u * tet], vertices);
    Float4 bend[6][3];
    for (std::size_t edge = 0; edge < 6; ++edge) {
      for (std::size_t c = 0; c < 3; ++c) bend[edge][c] = splat4(bend_[3u * edge_of_[6u * tet + edge] + c]);
    }
    for (; k < e.blocks() && e.tetrahedron[k] == tet; ++k, b += 12, to += 12) {
      const Float4 b1 = load4(b), b2 = load4(b + 4), b3 = load4(b + 8), b0 = splat4(1.0f) - b1 - b2 - b3;
      const Float4 product[6] = {b0 * b1, b0 * b2, b0 * b3, b1 * b2, b1 * b3, b2 * b3};
      Float4 p[3];
      for (int c = 0; c < 3; ++c) {
        p[c] = linear(s, c, b1, b2, b3) + ((product[0] * bend[0][c] + product[1] * bend[1][c]) +
                                           (product[2] * bend[2][c] + product[3] * bend[3][c]) +
                                           (product[4] * bend[4][c] + product[5] * bend[5][c]));
      }
      store_interleaved(to, p[0], p[1], p[2]);
    }
  }
}

}  // namespace nt
