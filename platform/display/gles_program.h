// SPDX-License-Identifier: Apache-2.0
// Shaders -> a program, and the fragment shader that all items of a scene share (its shapes: gles_renderer.h).
//
// `feedback`: a vertex shader's output to be read back, or null. Throws UserError with one line when the driver cannot.
#pragma once

namespace nt {

extern const char* const kSceneFragmentShader;
inline constexpr int kSolidShape = 3;  // lit by its normals, half transparent texels left out

unsigned link_program(const char* vertex_shader, const char* fragment_shader, const char* feedback = nullptr);

}  // namespace nt
