// SPDX-License-Identifier: Apache-2.0
// Lattices without a mesh: body-centred cells over any set of unit cubes, with bones through the centres.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "app/author/lattice_data.h"
#include "core/deform/lattice.h"
#include "tests/support/block.h"

namespace nt::test {

using Cell = std::array<int, 3>;

struct CellLattice {
  LatticeData data;
  std::map<Cell, uint16_t> centre;  // old numbers; valid until finish
  std::map<Cell, uint16_t> corner;

  uint16_t corner_at(Cell c) {
    const auto [it, is_new] = corner.try_emplace(c, static_cast<uint16_t>(data.vertices.size()));
    if (is_new) {
      data.vertices.push_back({static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])});
    }
    return it->second;
  }
  // Between two cells four tetrahedra around the line of their centres, at the surface a pyramid cut in two.
  explicit CellLattice(const std::vector<Cell>& cells) {
    for (const Cell& c : cells) {
      centre[c] = static_cast<uint16_t>(data.vertices.size());
      data.vertices.push_back(
          {static_cast<float>(c[0]) + 0.5f, static_cast<float>(c[1]) + 0.5f, static_cast<float>(c[2]) + 0.5f});
    }
    for (const Cell& c : cells) {
      for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) add_face(c, axis, side);
      }
    }
  }
  void add_face(const Cell& c, int axis, int side) {
    Cell next = c;
    next[axis] += side == 1 ? 1 : -1;
    const bool inner = centre.count(next) != 0;
    if (inner && side == 0) return;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    uint16_t ring[4];
    for (int k = 0; k < 4; ++k) {
      Cell at = c;
      at[axis] += side;
      at[u] += k == 1 || k == 2;
      at[v] += k >= 2;
      ring[k] = corner_at(at);
    }
    if (!inner) {
      add_tet(centre[c], ring[0], ring[1], ring[2]);
      add_tet(centre[c], ring[0], ring[2], ring[3]);
      return;
    }
    for (int k = 0; k < 4; ++k) add_tet(centre[c], centre[next], ring[k], ring[(k + 1) % 4]);
  }
  void add_tet(uint16_t a, uint16_t b, uint16_t c, uint16_t d) {
    data.tetrahedra.insert(data.tetrahedra.end(), {a, b, c, d});
  }
  // A straight bone of centres from one cell to another along an axis.
  std::vector<uint16_t> bone(Cell from, Cell to) {
    std::vector<uint16_t> list{centre.at(from)};
    while (from != to) {
      for (int a = 0; a < 3; ++a) from[a] += (to[a] > from[a]) - (to[a] < from[a]);
      list.push_back(centre.at(from));
    }
    return list;
  }
};

inline std::vector<Cell> box_cells(Cell low, Cell high) {
  std::vector<Cell> cells;
  for (int x = low[0]; x < high[0]; ++x) {
    for (int y = low[1]; y < high[1]; ++y) {
      for (int z = low[2]; z < high[2]; ++z) cells.push_back({x, y, z});
    }
  }
  return cells;
}

// A bar along x of length x side x side cells (side odd), a bone through it in `bones` parts, markers at the four corners
// of every `spacing`-th slice.
inline LatticeData bar(int length, int side, int bones, int spacing, const JointLimits& limits = {},
                       LatticeForm form = LatticeForm::arap) {
  CellLattice l(box_cells({0, 0, 0}, {length, side, side}));
  l.data.form = form;
  const int m = side / 2;
  uint16_t parent = kNoJoint;
  for (int k = 0; k <= bones; ++k) {
    const int from = k == 0 ? 0 : (k - 1) * (length - 1) / bones, to = k * (length - 1) / bones;
    l.data.add_joint(parent, k == 0 ? l.bone({0, m, m}, {0, m, m}) : l.bone({from, m, m}, {to, m, m}),
                     k == 0 ? JointLimits{} : limits);
    parent = static_cast<uint16_t>(k);
  }
  for (int x = 0; x <= length; x += spacing) {
    for (int k = 0; k < 4; ++k) l.data.add_marker(l.corner.at({x, k % 2 * side, k / 2 * side}));
  }
  const Status s = put_in_order(l.data);
  if (!s.ok()) l.data = {};
  return l.data;
}

// 441 and 1,012 vertices: the sizes that [L] and METHOD speak of.
inline LatticeData small_bar() { return bar(17, 3, 4, 4); }
inline LatticeData large_bar() { return bar(16, 5, 4, 4); }

// A solver and its memory.
class Solver {
 public:
  explicit Solver(const LatticeData& data, const LatticeSettings& settings = {})
      : view_(data.view()), block_(Lattice::bytes_needed(view_)) {
    Arena arena(block_.span());
    auto made = Lattice::create(arena, view_, settings);
    if (made.ok()) lattice_ = made.value();
    used_ = arena.used();
    seen_.assign(view_.markers.size(), 1);
  }
  Lattice& operator*() { return *lattice_; }
  Lattice* operator->() { return lattice_; }
  LatticeReport step(const std::vector<Vec3>& markers) { return lattice_->step(markers, seen_); }
  const LatticeView& view() const { return view_; }
  std::size_t bytes() const { return block_.span().size(); }
  std::size_t used() const { return used_; }

 private:
  LatticeView view_;
  Block block_;
  Lattice* lattice_ = nullptr;
  std::size_t used_ = 0;
  std::vector<uint8_t> seen_;
};

inline std::vector<Vec3> rest_markers(const LatticeView& view) {
  std::vector<Vec3> list;
  for (const MarkerBinding& m : view.markers) {
    Vec3 sum;
    for (int k = 0; k < 4; ++k) sum += m.weight[k] * view.vertices[m.vertex[k]];
    list.push_back(sum);
  }
  return list;
}

// Bends the x axis into a circle of curvature k in the x-z plane.
inline Vec3 bent(Vec3 p, float k) {
  if (det::abs(k) < 1e-6f) return p;
  const det::SinCos a = det::sincos(k * p.x);
  const float r = 1.0f / k + p.z;
  return {r * a.sin, p.y, r * a.cos - 1.0f / k};
}
inline std::vector<Vec3> bent_markers(const LatticeView& view, float k) {
  std::vector<Vec3> list = rest_markers(view);
  for (Vec3& p : list) p = bent(p, k);
  return list;
}

inline float largest_step(std::span<const Vec3> a, std::span<const Vec3> b) {
  float most = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) most = det::max(most, length(a[i] - b[i]));
  return most;
}
inline float rms_step(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += length_sq(a[i] - b[i]);
  return static_cast<float>(det::sqrt(sum / static_cast<double>(a.size())));
}

}  // namespace nt::test
