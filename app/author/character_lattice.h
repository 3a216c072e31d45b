// SPDX-License-Identifier: Apache-2.0
// A solid character -> the lattice of its character file. Off the frame path.
//
// Input: a character, and what the lattice is moved by. Output: arrays that CharacterLattice views
// (core/character/character.h), in character units.
// landmarks: the skeleton is the midline, a tree from the centre to head and tail with a joint at each axis point; the
//   markers are the control points that Retarget moves. The midline lies at one height, the middle of the body along it; a
//   fin's points at the middle of the mesh above and below them.
// markers: skeleton and markers are given.
// Cost: about 0.5 s. Errors: UserError with one line.
#pragma once
#include <string>
#include <vector>

#include "app/author/lattice_builder.h"
#include "core/character/character.h"

namespace nt {

class LatticeAsset {
 public:
  // The character need not outlive it.
  LatticeAsset(const Character& character, const SkeletonSpec& skeleton, const std::vector<MarkerSpec>& markers,
               LatticeDrive drive, const LatticeOptions& options);
  // Views what this owns.
  CharacterLattice view() const;
  const BuiltLattice& built() const { return built_; }

 private:
  BuiltLattice built_;
  std::vector<char> names_;
  LatticeDrive drive_;
};

inline constexpr int kFishLatticeVertices = 450;

LatticeAsset fish_lattice(const Character& character, const LatticeOptions& options);

// With curves along its limbs (curve_skeleton.h) for a skeleton, and no markers: to be pulled at by hand.
LatticeAsset limbed_lattice(const Character& character, const LatticeOptions& options);

// "of 450 vertices, 1,300 tetrahedra, ...": one line for the user.
std::string describe(const LatticeAsset& asset);

}  // namespace nt
