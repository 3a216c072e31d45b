// SPDX-License-Identifier: Apache-2.0
#include "core/deform/lattice_view.h"

#include <algorithm>

#include "core/deform/bit_table.h"
#include "core/deform/elimination_order.h"

namespace nt {
namespace {

void add_tetrahedra(BitTable& table, std::span<const uint16_t> tetrahedra) {
  for (std::size_t t = 0; t + 3 < tetrahedra.size(); t += 4) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (tetrahedra[t + a] != tetrahedra[t + b]) table.set(tetrahedra[t + a], tetrahedra[t + b]);
      }
    }
  }
}

// Two steps along edges count as one: the pattern of L^T L.
void add_second_ring(const BitTable& edges, BitTable& both) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    both.add_row(i, i);
    edges.each(i, [&](std::size_t j) { both.set(i, j); });
    edges.each(i, [&](std::size_t j) { edges.each(j, [&](std::size_t k) { both.set(i, k); }); });
    both.clear(i, i);
  }
}

bool indices_below(std::span<const uint16_t> indices, std::size_t limit) {
  return std::all_of(indices.begin(), indices.end(), [&](uint16_t i) { return i < limit; });
}

// Adds l cot(alpha) of each tetrahedron to the weight of the opposite edge: alpha is the dihedral angle at the edge of
// length l. For the edge ab with the other corners c, d: cot = (n_c . n_d) / (|n_c x n_d|), and |n_c x n_d| = l 6V.
template <class F>
void each_edge_weight(std::span<const Vec3> x, const uint16_t* tet, F f) {
  constexpr int kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  for (const auto& e : kEdges) {
    const Vec3 i = x[tet[e[0]]], j = x[tet[e[1]]], a = x[tet[e[2]]], b = x[tet[e[3]]];
    const Vec3 at_i = cross(b - a, i - a), at_j = cross(b - a, j - a);
    const Vec3 both = cross(at_i, at_j);
    const float l_sin = length(both);
    if (l_sin > 0.0f) f(tet[e[0]], tet[e[1]], length(b - a) * dot(at_i, at_j) / l_sin * (1.0f / 6.0f));
  }
}

std::size_t edge_slot(const LatticeView& v, uint16_t i, uint16_t j) {
  const uint16_t* first = v.neighbours.data() + v.neighbour_start[i];
  const uint16_t* last = v.neighbours.data() + v.neighbour_start[i + 1u];
  return static_cast<std::size_t>(std::lower_bound(first, last, j) - v.neighbours.data());
}

void clamp_weights(std::span<float> weights, std::span<float> scratch) {
  for (std::size_t k = 0; k < weights.size(); ++k) scratch[k] = det::abs(weights[k]);
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  const float median = *middle > 0.0f ? *middle : 1.0f;
  for (float& w : weights) w = det::clamp(w / median, 0.05f, 20.0f);
}

// Fills start and entries from the rows of a table; only columns above the row if `above`.
std::size_t count_entries(const BitTable& table, bool above) {
  std::size_t n = 0;
  for (std::size_t r = 0; r < table.size(); ++r) table.each(r, [&](std::size_t c) { n += !above || c > r; });
  return n;
}
void list_entries(const BitTable& table, bool above, std::span<uint32_t> start, std::span<uint16_t> entries) {
  uint32_t n = 0;
  for (std::size_t r = 0; r < table.size(); ++r) {
    start[r] = n;
    table.each(r, [&](std::size_t c) {
      if (!above || c > r) entries[n++] = static_cast<uint16_t>(c);
    });
  }
  start[table.size()] = n;
}

Status bad(const char* message) { return {StatusCode::bad_data, message}; }

Status check_solid(std::span<const Vec3> vertices, std::span<const uint16_t> tetrahedra) {
  if (vertices.size() < 4 || vertices.size() > 0xfffe || tetrahedra.size() < 4 || tetrahedra.size() % 4 != 0) {
    return bad("a lattice needs at least one tetrahedron and at most 65534 vertices");
  }
  if (!indices_below(tetrahedra, vertices.size())) return bad("a tetrahedron names a vertex that is not there");
  for (std::size_t t = 0; t < tetrahedra.size(); t += 4) {
    const Vec3 a = vertices[tetrahedra[t]], b = vertices[tetrahedra[t + 1]], c = vertices[tetrahedra[t + 2]],
               d = vertices[tetrahedra[t + 3]];
    if (!(volume6(a, b, c, d) > 0.0f)) return bad("a tetrahedron of the lattice has no volume");
  }
  return {};
}

}  // namespace

bool elimination_order(Arena& scratch, std::size_t vertices, std::span<const uint16_t> tetrahedra, LatticeForm form,
                       std::span<uint16_t> place) {
  BitTable graph(scratch, vertices);
  if (!graph.ok() || !indices_below(tetrahedra, vertices)) return false;
  add_tetrahedra(graph, tetrahedra);
  if (form == LatticeForm::stacked) {
    BitTable both(scratch, vertices);
    if (!both.ok()) return false;
    add_second_ring(graph, both);
    graph = both;
  }
  return smallest_factor_order(scratch, graph, place);
}

Result<LatticeView> derive_lattice(Arena& out, Arena& scratch, std::span<const Vec3> vertices,
                                   std::span<const uint16_t> tetrahedra, LatticeForm form) {
  if (const Status s = check_solid(vertices, tetrahedra); !s.ok()) return s;
  const Status no_room{StatusCode::out_of_memory, "not enough memory for the lattice's pattern"};
  const std::size_t n = vertices.size();
  LatticeView view;
  view.form = form;
  view.vertices = vertices;
  view.tetrahedra = tetrahedra;
  BitTable edges(scratch, n);
  if (!edges.ok()) return no_room;
  add_tetrahedra(edges, tetrahedra);
  const std::size_t neighbours = count_entries(edges, false);
  const auto start = out.take<uint32_t>(n + 1);
  const auto list = out.take<uint16_t>(neighbours);
  const auto weights = out.take<float>(neighbours);
  const auto magnitudes = scratch.take<float>(neighbours);
  if (start.size() != n + 1 || list.empty() || weights.empty() || magnitudes.empty()) return no_room;
  list_entries(edges, false, start, list);
  view.neighbour_start = start, view.neighbours = list, view.weights = weights;
  for (std::size_t t = 0; t < tetrahedra.size(); t += 4) {
    each_edge_weight(vertices, tetrahedra.data() + t, [&](uint16_t i, uint16_t j, float w) {
      weights[edge_slot(view, i, j)] += w;
      weights[edge_slot(view, j, i)] += w;
    });
  }
  clamp_weights(weights, magnitudes);

  BitTable graph(scratch, n);
  if (!graph.ok()) return no_room;
  if (form == LatticeForm::stacked) {
    add_second_ring(edges, graph);
  } else {
    graph = edges;
  }
  for (std::size_t v = 0; v < n; ++v) eliminate(graph, v);
  const std::size_t entries = count_entries(graph, true);
  const auto columns = out.take<uint32_t>(n + 1);
  const auto rows = out.take<uint16_t>(entries);
  if (columns.size() != n + 1 || rows.size() != entries) return no_room;
  list_entries(graph, true, columns, rows);
  view.column_start = columns, view.rows = rows;
  return view;
}

namespace {

// Starts rise from 0 to `entries`, and every list rises and stays below n (above its own number if `above`).
bool lists_are_sound(std::span<const uint32_t> start, std::span<const uint16_t> entries, std::size_t n, bool above) {
  if (start.size() != n + 1 || start[0] != 0 || start[n] != entries.size()) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (start[i] > start[i + 1] || start[i + 1] > entries.size()) return false;
    for (uint32_t p = start[i]; p < start[i + 1]; ++p) {
      if (entries[p] >= n || (above && entries[p] <= i) || (p > start[i] && entries[p] <= entries[p - 1])) return false;
    }
  }
  return true;
}

// The fill-in of a column lies in the column of its first row: what the factorisation and the assembly rely on.
bool pattern_is_closed(const LatticeView& v) {
  const auto column = [&](std::size_t j) {
    return v.rows.subspan(v.column_start[j], v.column_start[j + 1] - v.column_start[j]);
  };
  for (std::size_t j = 0; j < v.vertices.size(); ++j) {
    const auto rows = column(j);
    const auto first = v.neighbours.begin() + v.neighbour_start[j],
               last = v.neighbours.begin() + v.neighbour_start[j + 1];
    if (!std::includes(rows.begin(), rows.end(), std::upper_bound(first, last, j), last)) return false;
    if (rows.empty()) continue;
    const auto next = column(rows[0]);
    if (!std::includes(next.begin(), next.end(), rows.begin() + 1, rows.end())) return false;
  }
  return true;
}

bool adjacent(const LatticeView& v, uint16_t a, uint16_t b) {
  return std::binary_search(v.neighbours.begin() + v.neighbour_start[a],
                            v.neighbours.begin() + v.neighbour_start[a + 1u], b);
}

// Every vertex has a neighbour, and both ends of an edge know its weight: the solver goes through each edge from one of them.
bool edges_are_mutual(const LatticeView& v) {
  for (std::size_t i = 0; i < v.vertices.size(); ++i) {
    if (v.neighbour_start[i] == v.neighbour_start[i + 1]) return false;
    for (uint32_t p = v.neighbour_start[i]; p < v.neighbour_start[i + 1]; ++p) {
      const auto j = v.neighbours[p];
      const auto first = v.neighbours.begin() + v.neighbour_start[j],
                 last = v.neighbours.begin() + v.neighbour_start[j + 1u];
      const auto back = std::lower_bound(first, last, static_cast<uint16_t>(i));
      if (j == i || back == last || *back != i) return false;
      if (v.weights[static_cast<std::size_t>(back - v.neighbours.begin())] != v.weights[p]) return false;
    }
  }
  return true;
}

bool marker_is_sound(const LatticeView& v, const MarkerBinding& m) {
  for (int a = 0; a < 4; ++a) {
    if (m.vertex[a] >= v.vertices.size() || !(m.weight[a] > -1e3f && m.weight[a] < 1e3f)) return false;
    for (int b = 0; b < a; ++b) {
      if (m.weight[a] != 0.0f && m.weight[b] != 0.0f && !adjacent(v, m.vertex[a], m.vertex[b])) return false;
    }
  }
  return true;
}

bool chain_is_sound(const LatticeView& v, std::size_t joint) {
  const SkeletonView& s = v.skeleton;
  const uint32_t first = s.chain_start[joint], end = s.chain_start[joint + 1];
  if (s.parent[joint] == kNoJoint) return first == end;
  if (s.parent[joint] >= joint || end < first + 2) return false;
  if (s.chain[first] != s.vertex[s.parent[joint]] || s.chain[end - 1] != s.vertex[joint]) return false;
  for (uint32_t p = first + 1; p < end; ++p) {
    if (!adjacent(v, s.chain[p - 1], s.chain[p])) return false;
  }
  return true;
}

bool skeleton_is_sound(const LatticeView& v) {
  const SkeletonView& s = v.skeleton;
  const std::size_t n = s.joints();
  if (s.parent.size() != n || s.limits.size() != n || (n > 0 && s.chain_start.size() != n + 1)) return false;
  if (!indices_below(s.vertex, v.vertices.size()) || !indices_below(s.chain, v.vertices.size())) return false;
  for (std::size_t j = 0; j < n; ++j) {
    if (s.chain_start[j] > s.chain_start[j + 1] || s.chain_start[j + 1] > s.chain.size() || !chain_is_sound(v, j)) {
      return false;
    }
    const JointLimits& l = s.limits[j];
    if (!(l.twist_min <= l.twist_max && l.y_min <= l.y_max && l.z_min <= l.z_max)) return false;
  }
  return true;
}

}  // namespace

Status check_lattice(const LatticeView& view, const Limits& limits) {
  if (view.vertices.size() > static_cast<std::size_t>(limits.max_lattice_vertices)) {
    return {StatusCode::unsupported,
            "the lattice has too many vertices; raise max_lattice_vertices or make it coarser"};
  }
  if (const Status s = check_solid(view.vertices, view.tetrahedra); !s.ok()) return s;
  for (const Vec3 p : view.vertices) {
    if (!(det::abs(p.x) <= 1e6f && det::abs(p.y) <= 1e6f && det::abs(p.z) <= 1e6f)) {
      return bad("a vertex of the lattice is out of range");
    }
  }
  const std::size_t n = view.vertices.size();
  if (!lists_are_sound(view.neighbour_start, view.neighbours, n, false) ||
      view.weights.size() != view.neighbours.size() || !lists_are_sound(view.column_start, view.rows, n, true) ||
      !pattern_is_closed(view) || !edges_are_mutual(view)) {
    return bad("the lattice's pattern is damaged");
  }
  for (const float w : view.weights) {
    if (!(w >= 0.04f && w <= 21.0f)) return bad("a weight of the lattice is out of range");
  }
  for (const MarkerBinding& m : view.markers) {
    if (!marker_is_sound(view, m)) return bad("a marker of the lattice is not bound to one tetrahedron");
  }
  if (!skeleton_is_sound(view)) return bad("the lattice's skeleton is damaged");
  return {};
}

}  // namespace nt
