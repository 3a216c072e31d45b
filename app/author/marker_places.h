// SPDX-License-Identifier: Apache-2.0
// Markers placed on a mesh by hand, as text: one a line,
//   NAME X Y Z      a place in the mesh's unit and axes
//   NAME VERTEX     the mesh's vertex of that number, from 0, in the order in which triangle_mesh.h reads them
// # starts a comment. The file's name ends in .txt or .markers. Errors: UserError with one line that names the line.
#pragma once
#include <string>
#include <vector>

#include "app/author/lattice_builder.h"

namespace nt {

bool is_marker_places(const std::string& path);
std::vector<MarkerSpec> parse_marker_places(const std::string& text, const std::string& name, const TriangleMesh& mesh);
std::vector<MarkerSpec> read_marker_places(const std::string& path, const TriangleMesh& mesh);

}  // namespace nt
