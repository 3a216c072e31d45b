// SPDX-License-Identifier: Apache-2.0
// The joints of a rigged mesh or a motion file, read by Assimp; part of libneontetra_codecs.so.
//
// glTF, GLB: the joints of its skins where the vertices of the bind pose have them. BVH: its joints and end sites by their offsets.
// Unit and axes are the file's own, as those of read_triangles. Joints that lie where their parent lies are left out. No limits.
// Errors: UserError with one line.
#pragma once
#include <string>

#include "app/author/lattice_builder.h"

namespace nt {

SkeletonSpec read_joint_file(const std::string& path);

}  // namespace nt
