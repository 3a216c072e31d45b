// SPDX-License-Identifier: Apache-2.0
// The part of `neontetra character` that gives a 3D character its lattice: options -> skeleton, markers -> lattice.
//
// Skeleton and markers are in the mesh file's unit and axes; FigureFromFile (picture_character.h) and the character's own
// figure frame lay them onto the character. Without either of them the lattice is a swimmer's: midline and control points.
#pragma once
#include <optional>
#include <string>

#include "app/author/character_lattice.h"
#include "app/author/picture_character.h"
#include "app/mocap/marker_choice.h"

namespace CLI {
class App;
}

namespace nt {

struct LatticeRequest {
  bool wanted = false, stacked = false;
  std::string skeleton, markers;
  MarkerChoice choice;  // of a recording
  std::optional<int> vertices;
  bool by_markers() const { return !skeleton.empty() || !markers.empty(); }
};

void add_lattice_options(CLI::App& command, LatticeRequest& request);

// `mesh`: the file that the character was made from, and where it lies in the figure; null for a character file.
LatticeAsset lattice_for(const Character& character, const LatticeRequest& request, const std::string& mesh,
                         const FigureFromFile* figure_from_file);

}  // namespace nt
