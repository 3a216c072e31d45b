// SPDX-License-Identifier: Apache-2.0
// LatticeFigures as text beside a column of [L] Table I, and as JSON.
#pragma once
#include <string>
#include <vector>

#include "app/bench/lattice_bench.h"
#include "app/export/report.h"

namespace nt {

// [L] Table I, times on a Core2 Duo of 2.7 GHz, 50 iterations; its triangles of the control mesh are four a tetrahedron.
struct PaperFigures {
  const char* name;
  int mesh_vertices, mesh_triangles, vertices, tetrahedra;
  double factorise_s, update_s, embed_s, rrms, volume, bone_sum;
};
inline constexpr PaperFigures kPaperTable[] = {
    {"armadillo", 172914, 345944, 423, 1273, 0.101, 0.012, 0.063, 0.04, 0.042, 0.19},
    {"body", 8256, 15198, 1946, 6591, 1.836, 0.068, 0.014, 0.101, 0.012, 0.019},
    {"hand", 5023, 10042, 368, 1182, 0.102, 0.012, 0.002, 0.087, 0.061, 0.016},
};

struct LatticeColumn {
  std::string name;
  LatticeFigures figures;
};

std::string lattice_table(const std::vector<LatticeColumn>& columns, bool with_paper);
Json lattice_json(const LatticeColumn& column);

}  // namespace nt
