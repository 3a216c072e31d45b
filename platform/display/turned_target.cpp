// SPDX-License-Identifier: Apache-2.0
#include "platform/display/turned_target.h"

#include <GLES3/gl3.h>

#include "platform/camera.h"
#include "platform/display/gles_program.h"
#include "platform/display/rotation.h"

namespace nt {
namespace {

// One triangle strip over the whole screen; `turn` is the rotation's cosine and sine, y up.
constexpr const char* kVertexShader = R"(#version 300 es
uniform vec2 turn;
out vec2 v_uv;
out mediump vec4 v_colour;
void main() {
  vec2 corner = vec2(float(gl_VertexID % 2), float(gl_VertexID / 2));
  vec2 at = 2.0 * corner - 1.0;
  v_uv = corner;
  v_colour = vec4(1.0);
  gl_Position = vec4(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x, 0.0, 1.0);
}
)";
}  // namespace

TurnedTarget::TurnedTarget(int rotation_deg)
    : rotation_deg_(rotation_deg), program_(link_program(kVertexShader, Shape::textured)) {
  glGenVertexArrays(1, &vertex_array_);
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &colour_);
  glGenRenderbuffers(1, &depth_);
}

TurnedTarget::~TurnedTarget() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &colour_);
  glDeleteRenderbuffers(1, &depth_);
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteProgram(program_);
}

void TurnedTarget::begin(DisplaySize screen) {
  const DisplaySize wanted = upright(screen, rotation_deg_);
  if (wanted.width != size_.width || wanted.height != size_.height) resize(wanted);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
}

void TurnedTarget::resize(DisplaySize upright) {
  size_ = upright;
  glBindTexture(GL_TEXTURE_2D, colour_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.width, size_.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);  // pixel to pixel
  for (const unsigned wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, size_.width, size_.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw UserError("--rotation: the graphics driver cannot draw " + std::to_string(size_.width) + "x" +
                    std::to_string(size_.height) + " pixels turned; make the window smaller");
}

void TurnedTarget::show(DisplaySize screen) {
  constexpr float kCosSin[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const float* turn = kCosSin[rotation_deg_ / 90];
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, screen.width, screen.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glUseProgram(program_);
  glUniform2f(glGetUniformLocation(program_, "turn"), turn[0], turn[1]);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, colour_);
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace nt
