// SPDX-License-Identifier: Apache-2.0
#include "platform/display/lattice_mesh.h"

#include <GLES3/gl3.h>

#include <algorithm>
#include <cstddef>

#include "platform/display/gles_program.h"

namespace nt {
namespace {

constexpr const char* kVertexShader = R"(#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in uvec4 corners;
layout(location = 1) in vec3 weights;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 normal;
uniform highp sampler2D lattice;  // 3 texels a vertex: place and the first of F, then F
uniform highp sampler2D rest;
uniform bool phong;
uniform vec4 canvas;   // scale and offset from scene pixels to clip space
uniform vec4 frame;    // origin and up in scene pixels
uniform vec2 depth;    // middle and half extent of the heights
uniform vec4 tint;
out vec3 v_place;
out highp vec2 v_uv;
out highp float v_edge;
out mediump vec4 v_colour;
out mediump vec3 v_normal;
void main() {
  float b[4] = float[4](1.0 - weights.x - weights.y - weights.z, weights.x, weights.y, weights.z);
  vec3 at_rest[4];
  vec3 middle = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    at_rest[k] = texelFetch(rest, ivec2(0, int(corners[k])), 0).xyz;
    middle += b[k] * at_rest[k];
  }
  vec3 place = vec3(0.0);
  vec3 turned = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    int row = int(corners[k]);
    vec4 p = texelFetch(lattice, ivec2(0, row), 0);
    vec4 q = texelFetch(lattice, ivec2(1, row), 0);
    vec4 r = texelFetch(lattice, ivec2(2, row), 0);
    mat3 f = mat3(vec3(p.w, q.xy), vec3(q.zw, r.x), r.yzw);
    place += b[k] * (phong ? p.xyz + 0.5 * (f * (middle - at_rest[k])) : p.xyz);
    turned += b[k] * (f * normal);
  }
  v_place = place;
  vec2 up = frame.zw;
  vec2 right = vec2(-up.y, up.x);
  float zoom = length(up);
  vec2 at = frame.xy + right * place.x + up * place.y;
  vec2 side = (right * turned.x + up * turned.y) / zoom;
  v_normal = vec3(side, turned.z);
  v_uv = uv;
  v_edge = 0.0;
  v_colour = vec4(tint.rgb * tint.a, tint.a);
  gl_Position = vec4(at * canvas.xy + canvas.zw, clamp((depth.x - place.z) / depth.y, -1.0, 1.0), 1.0);
}
)";

struct Vertex {
  uint16_t corners[4];
  float weights[3];
  Vec2 uv;
  Vec3 normal;
};

// A texture of floats that the shader reads by texel.
void float_texture(unsigned handle, int width, std::size_t height, const float* values) {
  glBindTexture(GL_TEXTURE_2D, handle);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, static_cast<int>(height), 0, GL_RGBA, GL_FLOAT, values);
}

}  // namespace

LatticeMeshes::~LatticeMeshes() {
  for (const Mesh& m : meshes_) {
    glDeleteVertexArrays(1, &m.vertex_array);
    glDeleteBuffers(3, m.buffers);
    glDeleteTextures(2, m.textures);
  }
  if (program_ != 0) glDeleteProgram(program_);
}

void LatticeMeshes::start() {
  if (program_ != 0) return;
  program_ = link_program(kVertexShader, Shape::solid, "v_place");
  glUseProgram(program_);
  glUniform1i(glGetUniformLocation(program_, "picture"), 0);
  glUniform1i(glGetUniformLocation(program_, "lattice"), 1);
  glUniform1i(glGetUniformLocation(program_, "rest"), 2);
  canvas_ = glGetUniformLocation(program_, "canvas"), frame_ = glGetUniformLocation(program_, "frame");
  depth_ = glGetUniformLocation(program_, "depth"), tint_ = glGetUniformLocation(program_, "tint");
  phong_ = glGetUniformLocation(program_, "phong");
}

LatticeMeshes::Mesh& LatticeMeshes::slot(const LatticeSkin& skin) {
  for (Mesh& m : meshes_) {
    if (m.id != skin.id) continue;
    if (m.revision != skin.revision) upload(m, skin);
    return m;
  }
  Mesh& m = meshes_.emplace_back();
  m.id = skin.id;
  glGenVertexArrays(1, &m.vertex_array);
  glGenBuffers(3, m.buffers);
  glGenTextures(2, m.textures);
  upload(m, skin);
  return m;
}

// Whatever does not index what is there is left out: the GPU must not read past it.
void LatticeMeshes::upload(Mesh& m, const LatticeSkin& skin) {
  const std::size_t count = skin.texcoords.size();
  std::vector<Vertex> vertices(count);
  for (std::size_t v = 0; v < count && 4 * v + 3 < skin.corners.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      vertices[v].corners[k] = std::min(skin.corners[4 * v + k], static_cast<uint16_t>(skin.rest.size() - 1));
    }
    for (std::size_t k = 0; k < 3; ++k) vertices[v].weights[k] = skin.weights[3 * v + k];
    vertices[v].uv = skin.texcoords[v], vertices[v].normal = skin.normals[v];
  }
  std::vector<uint32_t> triangles;
  for (std::size_t t = 0; t + 2 < skin.triangles.size(); t += 3) {
    const uint32_t* i = &skin.triangles[t];
    if (std::max({i[0], i[1], i[2]}) < count) triangles.insert(triangles.end(), i, i + 3);
  }
  m.revision = skin.revision;
  m.indices = static_cast<int>(triangles.size()), m.vertices = static_cast<int>(count);
  glBindVertexArray(m.vertex_array);
  glBindBuffer(GL_ARRAY_BUFFER, m.buffers[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * sizeof(Vertex)), vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m.buffers[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(uint32_t)), triangles.data(),
               GL_STATIC_DRAW);
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  const int stride = sizeof(Vertex);
  glVertexAttribIPointer(0, 4, GL_UNSIGNED_SHORT, stride, offset(offsetof(Vertex, corners)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, weights)));
  glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, uv)));
  glVertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, normal)));
  for (unsigned i = 0; i < 4; ++i) glEnableVertexAttribArray(i);
  staging_.assign(4 * skin.rest.size(), 0.0f);
  for (std::size_t i = 0; i < skin.rest.size(); ++i) {
    staging_[4 * i] = skin.rest[i].x, staging_[4 * i + 1] = skin.rest[i].y, staging_[4 * i + 2] = skin.rest[i].z;
  }
  glActiveTexture(GL_TEXTURE2);
  float_texture(m.textures[1], 1, skin.rest.size(), staging_.data());
}

void LatticeMeshes::prepare(const LatticeSkin& skin, const Mesh& m) {
  glUseProgram(program_);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, m.textures[1]);
  glActiveTexture(GL_TEXTURE1);
  float_texture(m.textures[0], static_cast<int>(kTexels), skin.rest.size(), skin.lattice.data());
  glActiveTexture(GL_TEXTURE0);
  glUniform1i(phong_, skin.phong);
  glBindVertexArray(m.vertex_array);
}

void LatticeMeshes::draw(const LatticeSkin& skin, const Colour& tint, const float canvas[4]) {
  if (skin.rest.empty() || skin.lattice.size() < 12 * skin.rest.size() || skin.texcoords.empty()) return;
  // The picture's texture stays bound to unit 0 meanwhile.
  start();
  const Mesh& m = slot(skin);
  prepare(skin, m);
  glUniform4fv(canvas_, 1, canvas);
  glUniform4f(frame_, skin.origin.x, skin.origin.y, skin.up.x, skin.up.y);
  // A bend lifts little; what leaves the range is clamped.
  const float half = std::max(0.8f * (skin.high - skin.low), 1e-6f);
  glUniform2f(depth_, 0.5f * (skin.low + skin.high), half);
  glUniform4f(tint_, tint.r, tint.g, tint.b, tint.a);
  glDrawElements(GL_TRIANGLES, m.indices, GL_UNSIGNED_INT, nullptr);
}

std::vector<float> LatticeMeshes::places(const LatticeSkin& skin) {
  start();
  const Mesh& m = slot(skin);
  prepare(skin, m);
  const std::size_t bytes = 3 * sizeof(float) * static_cast<std::size_t>(m.vertices);
  glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, m.buffers[2]);
  glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, m.buffers[2]);
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, m.vertices);
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  std::vector<float> out(3 * static_cast<std::size_t>(m.vertices));
  const void* mapped =
      glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
  if (mapped != nullptr) std::copy_n(static_cast<const float*>(mapped), out.size(), out.begin());
  glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  return out;
}

}  // namespace nt
