// SPDX-License-Identifier: Apache-2.0
#include "app/author/delaunay3.h"

// Qhull's C interface: its C++ headers are not valid C++20.
#include <libqhull_r/qhull_ra.h>

#include <algorithm>

#include "core/deform/lattice_view.h"
#include "platform/camera.h"

namespace nt {
namespace {

// Qhull's state, freed on every way out.
struct QhullState {
  qhT state;
  QhullState() { qh_zero(&state, nullptr); }
  ~QhullState() {
    qh_freeqhull(&state, !qh_ALL);
    int short_bytes = 0, blocks = 0;
    qh_memfreeshort(&state, &short_bytes, &blocks);
  }
  QhullState(const QhullState&) = delete;
  QhullState& operator=(const QhullState&) = delete;
};

}  // namespace

std::vector<std::array<uint16_t, 4>> delaunay3(const std::vector<Vec3>& points) {
  std::vector<coordT> flat;
  for (const Vec3 p : points) {
    flat.insert(flat.end(), {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  }
  QhullState q;
  qhT* qh = &q.state;
  char command[] = "qhull d Qt Qbb Qc";
  const int failed =
      qh_new_qhull(qh, 3, static_cast<int>(points.size()), flat.data(), False, command, nullptr, nullptr);
  if (failed != 0) throw UserError("the mesh cannot be filled with tetrahedra; is it flat?");
  std::vector<std::array<uint16_t, 4>> out;
  facetT* facet = nullptr;
  FORALLfacets {
    if (facet->upperdelaunay) continue;
    std::array<uint16_t, 4> t{};
    std::size_t i = 0;
    vertexT* vertex = nullptr;
    vertexT** vertexp = nullptr;
    FOREACHvertex_(facet->vertices) {
      if (i < 4) t[i++] = static_cast<uint16_t>(qh_pointid(qh, vertex->point));
    }
    if (i != 4) continue;
    const float v = volume6(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
    if (v < 0.0f) std::swap(t[2], t[3]);
    if (v != 0.0f) out.push_back(t);
  }
  return out;
}

}  // namespace nt
