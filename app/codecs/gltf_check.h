// SPDX-License-Identifier: Apache-2.0
// What Assimp 5.2 takes on trust in a GLB or glTF file, looked at before it is given one.
//
// Found by damaging files at random: a chunk that is longer than its file keeps it busy for minutes, a skin without inverse bind
// matrices, which the format allows, makes it read through a null pointer, and one with fewer than it has joints past their end.
// Arrays within arrays, more than 256 deep, are refused too.
// Input: a path; files of other kinds pass. Errors: UserError with one line.
#pragma once
#include <string>

namespace nt {

void check_gltf(const std::string& path);

}  // namespace nt
