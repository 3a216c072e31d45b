// SPDX-License-Identifier: Apache-2.0
// A vertex shader and the shape that its triangles show -> a program.
//
// `feedback`: a vertex shader's output to be read back, or null. Throws UserError with one line when the driver cannot.
#pragma once
#include <cstdint>

namespace nt {

// textured: a picture. plain: one colour. band, disc: soft at the edge. solid: lit by its normals, half transparent texels left out.
enum class Shape : uint8_t { textured, band, disc, solid, plain };
inline constexpr int kShapes = 5;

unsigned link_program(const char* vertex_shader, Shape shape, const char* feedback = nullptr);

}  // namespace nt
