// SPDX-License-Identifier: Apache-2.0
// A skeleton as text: one joint a line, parents first,
//   NAME PARENT X Y Z [twist LOW HIGH] [y LOW HIGH] [z LOW HIGH]
// PARENT is a name or -, positions in the mesh's unit, limits in degrees against the rest pose; # starts a comment.
// Or the joints of a glTF, GLB or BVH file (app/codecs/joint_file.h), without limits.
// Errors: UserError with one line that names the line.
#pragma once
#include <string>

#include "app/author/lattice_builder.h"

namespace nt {

SkeletonSpec parse_skeleton(const std::string& text, const std::string& name);
SkeletonSpec read_skeleton(const std::string& path);
// The other way round, without limits that are none.
std::string skeleton_text(const SkeletonSpec& skeleton);

// What a --skeleton option names: a file, or `auto` for curve_skeleton.h; nothing for "".
SkeletonSpec skeleton_for(const std::string& path, const TriangleMesh& mesh);

}  // namespace nt
