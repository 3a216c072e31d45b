// SPDX-License-Identifier: Apache-2.0
// A closed outline -> triangles that fill it. Off the frame path.
//
// Input: the outline's points in order, either sense, and about how many vertices are wanted. Output: vertices (the outline's
// samples first, in order), triangles as index triples, all of positive area in the input's axes.
// Method: Delaunay (Qhull) of samples of the outline and a jittered hexagonal grid inside. The outline's edges are Delaunay
// by construction: it is sampled finer than the grid and the grid keeps away from it; where two sides of the outline come
// close, samples are halved until every edge is there. This stands in for [F]'s constrained triangulation [30].
// Cost: about 20 ms for 2,500 vertices.
#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/base/vec2.h"

namespace nt {

struct Triangulation {
  std::vector<Vec2> vertices;
  std::size_t outline_count = 0;  // vertices[0 .. outline_count) are the outline, in order
  std::vector<uint32_t> triangles;
};

// What is wrong with the outline, for the caller to say with the file's name.
struct TriangulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Triangulation triangulate(std::span<const Vec2> outline, int vertices_wanted);

}  // namespace nt
