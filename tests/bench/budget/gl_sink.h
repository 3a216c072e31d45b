// SPDX-License-Identifier: Apache-2.0
// An OpenGL ES 3.0 that draws nothing: what it is handed each frame it copies, as a driver must, and counts.
//
// With it the program's own renderer runs where there is no graphics processor. What a driver does beyond the copy (checking
// states, writing commands) is not in it.
#pragma once
#include <cstdint>

namespace nt::budget {

uint64_t gl_bytes_taken();  // since the program began

}  // namespace nt::budget
