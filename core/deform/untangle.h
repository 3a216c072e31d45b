// SPDX-License-Identifier: Apache-2.0
// No tetrahedron turned inside out: what as-rigid-as-possible energies do not forbid.
//
// Input: a posed lattice and which of its vertices may not move (those of bones: their lengths are exact). Output: the vertices
// nearest to them, one tetrahedron after the other, with which every tetrahedron keeps at least kLeastVolume of its volume
// at rest. Each that has less is given it along the gradient of its volume: the volume constraint of Mueller, Heidelberger,
// Hennix, Ratcliff, "Position based dynamics", 2007, as an inequality; sweeps alternate their direction.
// Not of [L], which reports no inverted tetrahedra and does not forbid them.
// Cost: one look at every tetrahedron, 6 ns each, and as much for each sweep where some are turned.
#pragma once
#include <cstdint>
#include <span>

#include "core/deform/lattice_view.h"

namespace nt {

inline constexpr float kLeastVolume = 0.02f;

// Returns how many tetrahedra still have less than no volume. `held`: one a vertex.
int untangle(const LatticeView& view, std::span<const uint8_t> held, int most_sweeps, std::span<Vec3> vertices);

}  // namespace nt
