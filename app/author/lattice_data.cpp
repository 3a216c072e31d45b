// SPDX-License-Identifier: Apache-2.0
#include "app/author/lattice_data.h"

#include <algorithm>

namespace nt {
namespace {

// A block of memory on a 64-byte line.
class Block {
 public:
  explicit Block(std::size_t bytes) : memory_(bytes + kAlignment), size_(bytes) {}
  std::span<std::byte> span() {
    auto* at = reinterpret_cast<std::byte*>(align_up(reinterpret_cast<std::size_t>(memory_.data())));
    return {at, size_};
  }

 private:
  std::vector<std::byte> memory_;
  std::size_t size_;
};

template <class T>
void assign(std::vector<T>& to, std::span<const T> from) {
  to.assign(from.begin(), from.end());
}

void renumber(LatticeData& l, const std::vector<uint16_t>& number) {
  std::vector<Vec3> vertices(l.vertices.size());
  for (std::size_t i = 0; i < number.size(); ++i) vertices[number[i]] = l.vertices[i];
  l.vertices = std::move(vertices);
  for (auto* list : {&l.tetrahedra, &l.joint_vertex, &l.chain}) {
    for (uint16_t& v : *list) v = number[v];
  }
  for (MarkerBinding& m : l.markers) {
    for (uint16_t& v : m.vertex) v = number[v];
  }
  for (std::size_t t = 0; t + 3 < l.tetrahedra.size(); t += 4) {
    uint16_t* tet = &l.tetrahedra[t];
    if (volume6(l.vertices[tet[0]], l.vertices[tet[1]], l.vertices[tet[2]], l.vertices[tet[3]]) < 0.0f) {
      std::swap(tet[2], tet[3]);
    }
  }
}

}  // namespace

void LatticeData::add_joint(uint16_t parent, const std::vector<uint16_t>& bone, const JointLimits& joint_limits) {
  joint_vertex.push_back(bone.back());
  joint_parent.push_back(parent);
  limits.push_back(joint_limits);
  if (parent != kNoJoint) chain.insert(chain.end(), bone.begin(), bone.end());
  chain_start.push_back(static_cast<uint32_t>(chain.size()));
}

void LatticeData::add_marker(uint16_t vertex) {
  MarkerBinding m;
  for (uint16_t& v : m.vertex) v = vertex;
  markers.push_back(m);
}

LatticeView LatticeData::view() const {
  LatticeView v;
  v.form = form;
  v.vertices = vertices, v.tetrahedra = tetrahedra;
  v.neighbour_start = neighbour_start, v.neighbours = neighbours, v.weights = weights;
  v.column_start = column_start, v.rows = rows;
  v.markers = markers;
  v.skeleton = {joint_vertex, joint_parent, chain_start, chain, limits};
  return v;
}

Status put_in_order(LatticeData& l, std::vector<uint16_t>* new_number) {
  const std::size_t n = l.vertices.size();
  if (n < 4 || n > 8192) return {StatusCode::bad_data, "a lattice has 4 to 8192 vertices"};
  Block scratch_block(n * n / 2 + n * 4096 + 65536), out_block(n * n * 2 + n * 1024 + 65536);
  std::vector<uint16_t> place(n), number(n);
  Arena ordering(scratch_block.span());
  if (!elimination_order(ordering, n, l.tetrahedra, l.form, place)) {
    return {StatusCode::bad_data, "a tetrahedron names a vertex that is not there"};
  }
  for (std::size_t k = 0; k < n; ++k) number[place[k]] = static_cast<uint16_t>(k);
  renumber(l, number);
  Arena out(out_block.span()), scratch(scratch_block.span());
  const auto derived = derive_lattice(out, scratch, l.vertices, l.tetrahedra, l.form);
  if (!derived.ok()) return derived.status();
  const LatticeView& v = derived.value();
  assign(l.neighbour_start, v.neighbour_start);
  assign(l.neighbours, v.neighbours);
  assign(l.weights, v.weights);
  assign(l.column_start, v.column_start);
  assign(l.rows, v.rows);
  if (new_number != nullptr) *new_number = number;
  return {};
}

}  // namespace nt
