// SPDX-License-Identifier: Apache-2.0
// Points -> the tetrahedron that holds them, or the one that they leave least. Off the frame path.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "app/author/lattice_builder.h"

namespace nt {

struct Binding {
  uint16_t tetrahedron = 0;
  std::array<float, 4> weight{};  // barycentric, sum 1
};

// The barycentric weights of p; all 0 for a tetrahedron without volume.
std::array<float, 4> barycentric(const std::array<Vec3, 4>& corner, Vec3 p);
float least_weight(const std::array<Vec3, 4>& corner, Vec3 p);

class Binder {
 public:
  // The tetrahedra must outlive it. Without `spacing` it is the mean edge.
  Binder(std::span<const Vec3> vertices, std::span<const uint16_t> tetrahedra, float spacing = 0.0f);
  Binding bind(Vec3 p) const;
  // As a marker of the lattice.
  MarkerBinding marker(Vec3 p) const;

 private:
  std::array<int, 3> bin_of(Vec3 p) const;
  std::array<Vec3, 4> corners(std::size_t tet) const;
  std::span<const Vec3> vertices_;
  std::span<const uint16_t> tetrahedra_;
  Vec3 low_;
  float bin_ = 1.0f;
  std::array<int, 3> size_{};
  std::vector<std::vector<uint16_t>> bins_;  // tetrahedra whose box meets the bin
};

// Every point, sorted by tetrahedron into blocks of four. `outside` counts those that no tetrahedron holds.
EmbeddingData embed_mesh(const std::vector<Vec3>& points, const Binder& binder, int& outside);

}  // namespace nt
