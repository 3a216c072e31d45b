// SPDX-License-Identifier: Apache-2.0
// A lattice while it is being made: the arrays of core/deform/lattice_view.h, owned.
//
// Whoever makes one fills the first part in any order of vertices; `put_in_order` renumbers everything into the
// elimination order and derives the rest. Needs core alone, so the core tests use it too.
#pragma once
#include <cstdint>
#include <vector>

#include "core/deform/lattice_view.h"

namespace nt {

struct LatticeData {
  LatticeForm form = LatticeForm::arap;
  std::vector<Vec3> vertices;
  std::vector<uint16_t> tetrahedra;  // 4 each; those of negative volume are turned round by put_in_order
  std::vector<MarkerBinding> markers;
  std::vector<uint16_t> joint_vertex, joint_parent;
  std::vector<uint32_t> chain_start{0};
  std::vector<uint16_t> chain;
  std::vector<JointLimits> limits;

  std::vector<uint32_t> neighbour_start;
  std::vector<uint16_t> neighbours;
  std::vector<float> weights;
  std::vector<uint32_t> column_start;
  std::vector<uint16_t> rows;

  // A joint at the end of `bone`, lattice vertices from the parent joint's to its own; a root's bone is its vertex alone.
  void add_joint(uint16_t parent, const std::vector<uint16_t>& bone, const JointLimits& joint_limits = {});
  void add_marker(uint16_t vertex);
  LatticeView view() const;
};

// `new_number`, if given, receives for each old vertex its number in the elimination order.
Status put_in_order(LatticeData& lattice, std::vector<uint16_t>* new_number = nullptr);

}  // namespace nt
