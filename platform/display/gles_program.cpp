// SPDX-License-Identifier: Apache-2.0
#include "platform/display/gles_program.h"

#include <GLES3/gl3.h>

#include <string>

#include "platform/camera.h"

namespace nt {
namespace {

// One program a shape, not one that asks which: a software renderer runs every branch of a fragment shader, and a `discard` in
// one of them costs all others their early depth test.
// A band or disc thinner than a display pixel is drawn one pixel wide and fainter, so that it does not break up.
std::string scene_fragment_shader(Shape shape) {
  return "#version 300 es\n#define SHAPE " + std::to_string(static_cast<int>(shape)) + R"(
precision highp float;
in vec2 v_uv;
in float v_edge;
in mediump vec4 v_colour;
in mediump vec3 v_normal;
uniform float scale;  // display pixels a scene pixel
uniform sampler2D picture;
out vec4 fragment;
void main() {
#if SHAPE == 0
  fragment = texture(picture, v_uv) * v_colour;
#elif SHAPE == 3
  vec4 texel = texture(picture, v_uv);
  if (texel.a < 0.5) discard;
  vec3 n = normalize(v_normal);
  n = n.z < 0.0 ? -n : n;  // both sides are shown
  float light = 0.52 + 0.58 * max(dot(n, vec3(-0.33, -0.42, 0.845)), 0.0);
  fragment = vec4(min(texel.rgb * light, texel.aaa), texel.a) * v_colour;
#elif SHAPE == 4
  fragment = v_colour;
#else
  float distance_px = (SHAPE == 1) ? abs(v_uv.x) : length(v_uv);
  float cover = clamp((v_edge - distance_px) * scale + 0.5, 0.0, 1.0);
  fragment = v_colour * min(cover, min(2.0 * v_edge * scale, 1.0));
#endif
}
)";
}

unsigned compile(unsigned kind, const std::string& source_text) {
  const char* source = source_text.c_str();
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  int ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == 0) throw UserError("OpenGL ES: this driver cannot compile GLSL ES 3.00 shaders; update it");
  return shader;
}

}  // namespace

unsigned link_program(const char* vertex_shader, Shape shape, const char* feedback) {
  const unsigned vertex = compile(GL_VERTEX_SHADER, vertex_shader);
  const unsigned fragment = compile(GL_FRAGMENT_SHADER, scene_fragment_shader(shape));
  const unsigned program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  if (feedback != nullptr) glTransformFeedbackVaryings(program, 1, &feedback, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  int ok = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok == 0) throw UserError("OpenGL ES: this driver cannot link GLSL ES 3.00 shaders; update it");
  return program;
}

}  // namespace nt
