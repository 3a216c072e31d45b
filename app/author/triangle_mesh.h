// SPDX-License-Identifier: Apache-2.0
// A mesh file -> its triangles, as the file has them: no axes turned, no parts left out but helpers. Off the frame path.
//
// Reads what Assimp reads (OBJ, glTF, GLB, PLY, ...). Vertices at the same place are one. Errors: UserError with one line.
#pragma once
#include <string>

#include "app/author/solid_grid.h"

namespace nt {

TriangleMesh read_triangles(const std::string& path);

// The same, inside libneontetra_codecs.so (platform/codecs.h).
TriangleMesh read_triangles_file(const std::string& path);

}  // namespace nt
