// SPDX-License-Identifier: Apache-2.0
// A mesh file -> the bytes of a 3D character file. Off the frame path.
//
// Steps, [F] sections 3.2 and 5: read and clean (mesh_file.h), lie down along its axes (mesh_axes.h), reduce to core's Limits
// (meshoptimizer's quadric simplifier, its vertex-clustering one where seams or loose parts stop the first), look at it from
// above: silhouette -> landmarks (proposal.h) -> control points at z = 0.
// Character units are pixels of that top view, kView of them along the longer side.
// Cost: 0.2 s, and 1 s more for 200,000 triangles. Errors: UserError with one line.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "app/author/mesh_axes.h"
#include "app/author/picture_character.h"

namespace nt {

struct MeshOptions {
  ToldAxes told;
  int u_num = 3, l_num = 15, harmonics = 5;
  int vertices = 0;  // most; 0: as many as core's Limits allow
};

AuthoredCharacter author_mesh(const std::string& path, const MeshOptions& options);

}  // namespace nt
