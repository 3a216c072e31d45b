// SPDX-License-Identifier: Apache-2.0
// A skeleton as text: one joint a line, parents first,
//   NAME PARENT X Y Z [twist LOW HIGH] [y LOW HIGH] [z LOW HIGH]
// PARENT is a name or -, positions in the mesh's unit, limits in degrees against the rest pose; # starts a comment.
// Errors: UserError with one line that names the line.
#pragma once
#include <string>

#include "app/author/lattice_builder.h"

namespace nt {

SkeletonSpec parse_skeleton(const std::string& text, const std::string& name);
SkeletonSpec read_skeleton(const std::string& path);

}  // namespace nt
