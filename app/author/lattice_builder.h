// SPDX-License-Identifier: Apache-2.0
// Any triangle mesh -> a coarse tetrahedral lattice that holds its skeleton and its markers. Off the frame path.
//
// Input: a mesh with holes, flipped or doubled faces, self-intersections, several parts; a skeleton and markers in the
// mesh's unit. Output: the lattice ready for core/deform (app/author/lattice_data.h) and the embedding of every mesh vertex.
// Source: [L] IV-A, without TetGen (AGPL), which needs a clean cage: solid cells by a vote of winding numbers
// (solid_grid.h) -> nodes of a body-centred grid within 0.8 spacings of the solid, jiggled by 4 % because a regular grid has
// eight nodes on one sphere -> skeleton samples inserted, nodes inside the ball over each skeleton edge deleted, so that
// every such edge is Delaunay by construction -> Delaunay (Qhull) -> tetrahedra that touch the solid, and the shortest
// others that hang parts together -> nodes moved to lift flat tetrahedra.
// Markers are bound to the tetrahedron around or nearest to them by barycentric weights; they need no node.
// Errors: UserError with one line: an empty mesh, a flat point, a skeleton that does not fit.
// Cost: about 0.3 s for 1,000 vertices.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/author/lattice_data.h"
#include "app/author/solid_grid.h"

namespace nt {

struct SkeletonSpec {
  struct Joint {
    std::string name;
    int parent = -1;  // an earlier joint
    Vec3 position;
    JointLimits limits;
  };
  std::vector<Joint> joints;
};

struct MarkerSpec {
  std::string name;
  Vec3 position;
};

struct LatticeOptions {
  int vertices = 600;  // about; 300 to 2,000
  LatticeForm form = LatticeForm::arap;
};

struct EmbeddingData {
  std::vector<float> coordinates;
  std::vector<uint16_t> tetrahedron;
  std::vector<uint32_t> source;  // of each of the four slots of a block, the mesh vertex
  std::vector<uint32_t> slot;    // of each mesh vertex, a slot
};

struct BuiltLattice {
  LatticeData data;
  EmbeddingData embedding;
  float spacing = 0.0f;
  float worst_marker_weight = 0.0f;  // below 0: a marker outside of the lattice, by so much of its tetrahedron
  int outside = 0;                   // mesh vertices outside of every tetrahedron, bound to the nearest
  float flattest = 0.0f;             // least 6 sqrt 2 V / l_rms^3 of a tetrahedron; 1 for a regular one
};

BuiltLattice build_lattice(const TriangleMesh& mesh, const SkeletonSpec& skeleton,
                           const std::vector<MarkerSpec>& markers, const LatticeOptions& options);

}  // namespace nt
