// SPDX-License-Identifier: Apache-2.0
#include "app/author/lattice_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "app/author/delaunay3.h"
#include "app/author/lattice_binding.h"
#include "app/author/lattice_nodes.h"
#include "core/base/random.h"
#include "platform/camera.h"

namespace nt {
namespace {

using Tet = std::array<uint16_t, 4>;
using Edge = std::pair<uint16_t, uint16_t>;
Edge edge(uint16_t a, uint16_t b) { return {std::min(a, b), std::max(a, b)}; }

constexpr int kCells = 72;      // of the solid, along its longest side
constexpr float kFlat = 0.02f;  // tetrahedra flatter than this are dropped where nothing needs them
constexpr float kLift = 0.15f;  // flatter ones are lifted by moving their nodes
constexpr int kTries = 4;       // with other jiggles

// 6 sqrt 2 V / l_rms^3: 1 for a regular tetrahedron, 0 for a flat one.
float quality(const std::vector<Vec3>& x, const Tet& t) {
  float squares = 0.0f;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) squares += length_sq(x[t[a]] - x[t[b]]);
  }
  const float rms = std::sqrt(squares / 6.0f);
  return rms > 0.0f ? 1.41421356f * volume6(x[t[0]], x[t[1]], x[t[2]], x[t[3]]) / (rms * rms * rms) : 0.0f;
}

std::set<Edge> skeleton_edges(const LatticeNodes& nodes) {
  std::set<Edge> out;
  for (const auto& bone : nodes.bones) {
    for (std::size_t k = 1; k < bone.size(); ++k) out.insert(edge(bone[k - 1], bone[k]));
  }
  return out;
}

bool holds_edge(const Tet& t, const std::set<Edge>& edges) {
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      if (edges.count(edge(t[a], t[b])) != 0) return true;
    }
  }
  return false;
}

bool touches_solid(const std::vector<Vec3>& x, const Tet& t, const SolidGrid& grid) {
  const std::array<Vec3, 4> corner = {x[t[0]], x[t[1]], x[t[2]], x[t[3]]};
  std::array<int, 3> low = grid.cell_of(corner[0]), high = low;
  for (const Vec3 p : corner) {
    const auto c = grid.cell_of(p);
    for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], c[a]), high[a] = std::max(high[a], c[a]);
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        if (grid.solid(i, j, k) && least_weight(corner, grid.centre(i, j, k)) >= -0.01f) return true;
      }
    }
  }
  return false;
}

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> parent_;
};

// Parts that hang on nothing would float freely: the shortest tetrahedra between them join in.
void connect(const std::vector<Vec3>& x, std::vector<Tet>& kept, std::vector<Tet>& others) {
  UnionFind groups(x.size());
  std::vector<uint8_t> used(x.size());
  for (const Tet& t : kept) {
    for (const uint16_t v : t) used[v] = 1, groups.join(t[0], v);
  }
  const auto longest = [&](const Tet& t) {
    float most = 0.0f;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) most = std::max(most, length_sq(x[t[a]] - x[t[b]]));
    }
    return most;
  };
  std::sort(others.begin(), others.end(), [&](const Tet& a, const Tet& b) { return longest(a) < longest(b); });
  // Kruskal over all tetrahedra; those whose nodes are not used at all only pass the connection on.
  for (const Tet& t : others) {
    std::set<std::size_t> met;
    for (const uint16_t v : t) met.insert(groups.find(v));
    const bool between = std::any_of(t.begin(), t.end(), [&](uint16_t v) { return used[v] != 0; });
    if (met.size() < 2 || !between || quality(x, t) < kFlat) continue;
    kept.push_back(t);
    for (const uint16_t v : t) used[v] = 1, groups.join(t[0], v);
  }
}

// Moves free nodes of flat tetrahedra at random as long as their flattest tetrahedron improves.
void lift(std::vector<Vec3>& x, std::size_t fixed, const std::vector<Tet>& tets, float h) {
  std::vector<std::vector<std::size_t>> around(x.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (const uint16_t v : tets[t]) around[v].push_back(t);
  }
  const auto worst = [&](uint16_t v) {
    float least = 1.0f;
    for (const std::size_t t : around[v]) least = std::min(least, quality(x, tets[t]));
    return least;
  };
  Random random(7);
  for (int sweep = 0; sweep < 6; ++sweep) {
    for (const Tet& t : tets) {
      if (quality(x, t) >= kLift) continue;
      for (const uint16_t v : t) {
        if (v < fixed) continue;
        for (int attempt = 0; attempt < 8; ++attempt) {
          const Vec3 before = x[v];
          const float least = worst(v);
          x[v] += (0.3f * h) * Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f};
          if (worst(v) <= least) x[v] = before;
        }
      }
    }
  }
}

// Leaves out nodes that no tetrahedron uses. Throws if a skeleton point is among them.
void compact(LatticeNodes& nodes, std::vector<Tet>& tets) {
  std::vector<uint8_t> used(nodes.points.size());
  for (const Tet& t : tets) {
    for (const uint16_t v : t) used[v] = 1;
  }
  std::vector<uint16_t> number(nodes.points.size());
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    number[i] = static_cast<uint16_t>(points.size());
    if (used[i]) points.push_back(nodes.points[i]);
  }
  nodes.points = std::move(points);
  for (Tet& t : tets) {
    for (uint16_t& v : t) v = number[v];
  }
  for (auto& bone : nodes.bones) {
    for (uint16_t& v : bone) v = number[v];
  }
}

// True if every skeleton edge is there.
bool fill(LatticeNodes& nodes, const SolidGrid& grid, std::vector<Tet>& kept) {
  const std::set<Edge> bones = skeleton_edges(nodes);
  std::vector<Tet> others;
  kept.clear();
  for (const Tet& t : delaunay3(nodes.points)) {
    const bool wanted = holds_edge(t, bones) || touches_solid(nodes.points, t, grid);
    (wanted ? kept : others).push_back(t);
  }
  lift(nodes.points, nodes.fixed, kept, nodes.spacing);
  std::erase_if(kept, [&](const Tet& t) { return quality(nodes.points, t) < (holds_edge(t, bones) ? 1e-4f : kFlat); });
  connect(nodes.points, kept, others);
  std::set<Edge> present;
  for (const Tet& t : kept) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) present.insert(edge(t[a], t[b]));
    }
  }
  return std::includes(present.begin(), present.end(), bones.begin(), bones.end());
}

// Far from the mesh in its own sizes: a file in other units. A lattice could not reach there.
bool within_reach(Vec3 p, const SolidGrid& grid) {
  const Vec3 low = grid.centre(0, 0, 0), high = grid.centre(grid.size(0) - 1, grid.size(1) - 1, grid.size(2) - 1);
  return length(p - 0.5f * (low + high)) <= length(high - low);
}

void check_reach(const SolidGrid& grid, const SkeletonSpec& skeleton, const std::vector<MarkerSpec>& markers) {
  for (const auto& joint : skeleton.joints) {
    if (!within_reach(joint.position, grid)) {
      throw UserError("joint '" + joint.name + "' lies far from the mesh; are both in the same unit?");
    }
  }
  for (const MarkerSpec& m : markers) {
    if (!within_reach(m.position, grid)) {
      throw UserError("marker '" + m.name + "' lies far from the mesh; are both in the same unit?");
    }
  }
}

void check(const TriangleMesh& mesh, const SkeletonSpec& skeleton, const std::vector<MarkerSpec>& markers) {
  const auto finite = [](Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  if (mesh.triangles.empty()) throw UserError("the mesh has no triangle that could be used");
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const auto& joint = skeleton.joints[j];
    if (!finite(joint.position)) throw UserError("joint '" + joint.name + "' has no position");
    if (joint.parent >= static_cast<int>(j)) throw UserError("joint '" + joint.name + "' comes before its parent");
    if (joint.parent >= 0 &&
        !(length(joint.position - skeleton.joints[static_cast<std::size_t>(joint.parent)].position) > 0.0f)) {
      throw UserError("joint '" + joint.name + "' lies on its parent; leave one of them out");
    }
  }
  for (const MarkerSpec& m : markers) {
    if (!finite(m.position)) throw UserError("marker '" + m.name + "' has no position");
  }
}

}  // namespace

BuiltLattice build_lattice(const TriangleMesh& source, const SkeletonSpec& skeleton,
                           const std::vector<MarkerSpec>& markers, const LatticeOptions& options) {
  const TriangleMesh mesh = cleaned(source);
  check(mesh, skeleton, markers);
  const SolidGrid grid(mesh, kCells, 12);
  check_reach(grid, skeleton, markers);
  LatticeNodes nodes;
  std::vector<Tet> tets;
  bool whole = false;
  for (uint64_t seed = 1; seed <= kTries && !whole; ++seed) {
    nodes = make_nodes(grid, skeleton, options.vertices, seed);
    if (nodes.points.size() > 8000) throw UserError("the skeleton is too fine for a lattice; leave out short bones");
    whole = fill(nodes, grid, tets);
  }
  if (!whole || tets.empty()) {
    throw UserError(
        "the skeleton does not fit into the lattice: bones cross or nearly touch; move them or ask for more "
        "--vertices");
  }
  compact(nodes, tets);
  BuiltLattice out;
  out.spacing = nodes.spacing;
  out.data.form = options.form;
  out.data.vertices = nodes.points;
  for (const Tet& t : tets) out.data.tetrahedra.insert(out.data.tetrahedra.end(), t.begin(), t.end());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    out.data.add_joint(parent < 0 ? kNoJoint : static_cast<uint16_t>(parent), nodes.bones[j],
                       skeleton.joints[j].limits);
  }
  if (const Status s = put_in_order(out.data); !s.ok()) throw UserError(s.message);
  out.flattest = 1.0f;
  for (std::size_t t = 0; t < out.data.tetrahedra.size(); t += 4) {
    const uint16_t* v = &out.data.tetrahedra[t];
    out.flattest = std::min(out.flattest, quality(out.data.vertices, Tet{v[0], v[1], v[2], v[3]}));
  }
  const Binder binder(out.data.vertices, out.data.tetrahedra, nodes.spacing);
  for (const MarkerSpec& m : markers) {
    out.data.markers.push_back(binder.marker(m.position));
    for (const float w : out.data.markers.back().weight) {
      out.worst_marker_weight = std::min(out.worst_marker_weight, w);
    }
  }
  out.embedding = embed_mesh(mesh.positions, binder, out.outside);
  return out;
}

}  // namespace nt
