// SPDX-License-Identifier: Apache-2.0
// The nodes of a lattice before they are joined: a body-centred grid around a solid, and a sampled skeleton.
#pragma once
#include <cstdint>
#include <vector>

#include "app/author/lattice_builder.h"

namespace nt {

struct LatticeNodes {
  std::vector<Vec3> points;  // skeleton samples first
  std::size_t fixed = 0;     // how many of them
  float spacing = 0.0f;
  std::vector<std::vector<uint16_t>> bones;  // of each joint, from its parent's point to its own; a root's own alone
};

// Nodes so that about `wanted` stay; `seed` chooses the jiggle.
LatticeNodes make_nodes(const SolidGrid& grid, const SkeletonSpec& skeleton, int wanted, uint64_t seed);

}  // namespace nt
