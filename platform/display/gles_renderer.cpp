// SPDX-License-Identifier: Apache-2.0
#include "platform/display/gles_renderer.h"

#include <GLES3/gl3.h>

#include <algorithm>
#include <cmath>

#include "platform/camera.h"
#include "platform/display/gles_program.h"

namespace nt {
namespace {

constexpr const char* kVertexShader = R"(#version 300 es
layout(location = 0) in vec2 at;
layout(location = 1) in vec2 uv;
layout(location = 2) in float edge_px;
layout(location = 3) in vec4 colour;
layout(location = 4) in float depth;
layout(location = 5) in vec3 normal;
uniform vec4 canvas;  // scale and offset from scene pixels to clip space
out highp vec2 v_uv;
out highp float v_edge;
out mediump vec4 v_colour;
out mediump vec3 v_normal;
void main() {
  v_normal = normal;
  v_uv = uv;
  v_edge = edge_px;
  v_colour = vec4(colour.rgb * colour.a, colour.a);
  gl_Position = vec4(at * canvas.xy + canvas.zw, depth, 1.0);
}
)";

struct GlFormat {
  unsigned internal, external;
  int bytes;
};

GlFormat gl_format(PixelFormat format) {
  switch (format) {
    case PixelFormat::luma8:
      return {GL_R8, GL_RED, 1};
    case PixelFormat::rgb8:
      return {GL_RGB8, GL_RGB, 3};
    case PixelFormat::rgba8:
      break;
  }
  return {GL_RGBA8, GL_RGBA, 4};
}

void pack(const Colour& colour, uint8_t* rgba) {
  const float channels[4] = {colour.r, colour.g, colour.b, colour.a};
  for (int i = 0; i < 4; ++i) rgba[i] = static_cast<uint8_t>(std::lround(std::clamp(channels[i], 0.0f, 1.0f) * 255.0f));
}

bool drawable(const Picture& picture) { return picture.pixels != nullptr && picture.width > 0 && picture.height > 0; }

// Half an edge's softness beyond the nominal edge, with a little to spare.
float soft_margin(float scale) { return 1.0f / scale; }

}  // namespace

GlesRenderer::GlesRenderer() {
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    const unsigned handle = link_program(kVertexShader, static_cast<Shape>(i));
    programs_[i] = {handle, glGetUniformLocation(handle, "canvas"), glGetUniformLocation(handle, "scale")};
  }
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glGenBuffers(1, &vertex_buffer_);
  glGenBuffers(1, &index_buffer_);
  glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  const int stride = sizeof(Vertex);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, at)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, uv)));
  glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, edge_px)));
  glVertexAttribPointer(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(Vertex, rgba)));
  glVertexAttribPointer(4, 1, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, depth)));
  glVertexAttribPointer(5, 3, GL_BYTE, GL_TRUE, stride, offset(offsetof(Vertex, normal)));
  for (unsigned i = 0; i < 6; ++i) glEnableVertexAttribArray(i);
}

GlesRenderer::~GlesRenderer() {
  for (const Texture& texture : textures_) glDeleteTextures(1, &texture.handle);
  glDeleteBuffers(1, &vertex_buffer_);
  glDeleteBuffers(1, &index_buffer_);
  glDeleteVertexArrays(1, &vertex_array_);
  for (const Program& program : programs_) glDeleteProgram(program.handle);
}

std::string GlesRenderer::description() {
  const auto text = [](unsigned name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return std::string(value != nullptr ? value : "unknown");
  };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

void GlesRenderer::draw(const Scene& scene, int display_width, int display_height, RowOrder rows) {
  const CanvasFit fit = fit_canvas(scene.width(), scene.height(), display_width, display_height);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, display_width, display_height);
  if (fit.width < display_width || fit.height < display_height) {  // bars beside the canvas
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  if (fit.width == 0) return;
  const bool top_down = rows == RowOrder::top_down;
  const int y = top_down ? fit.y : display_height - fit.y - fit.height;
  glViewport(fit.x, y, fit.width, fit.height);
  glScissor(fit.x, y, fit.width, fit.height);
  glEnable(GL_SCISSOR_TEST);
  const Colour back = scene.background();
  glClearColor(back.r * back.a, back.g * back.a, back.b * back.a, back.a);
  glClear(GL_COLOR_BUFFER_BIT);

  build(scene, fit.scale);
  upload_buffers();
  const float flip = top_down ? 1.0f : -1.0f;
  const float canvas[4] = {2.0f / static_cast<float>(scene.width()), flip * 2.0f / static_cast<float>(scene.height()),
                           -1.0f, -flip};
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  for (const Batch& batch : batches_) {
    if (batch.picture != nullptr) bind_texture(*batch.picture);
    if (batch.skinned != nullptr) {
      draw_skin(*batch.skinned, canvas);
      continue;
    }
    if (batch.shape == Shape::solid) {
      glEnable(GL_DEPTH_TEST);
      glClear(GL_DEPTH_BUFFER_BIT);
    } else {
      glDisable(GL_DEPTH_TEST);
    }
    use(batch.shape, canvas, fit.scale);
    glDrawElements(GL_TRIANGLES, static_cast<int>(batch.count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(batch.first * sizeof(uint32_t)));
  }
}

void GlesRenderer::use(Shape shape, const float* canvas, float scale) {
  const Program& program = programs_[static_cast<std::size_t>(shape)];
  glUseProgram(program.handle);
  glUniform4fv(program.canvas, 1, canvas);
  glUniform1f(program.scale, scale);
}

// Its own program and buffers, then back to the buffers of all others.
void GlesRenderer::draw_skin(const SceneItem& item, const float* canvas) {
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  skins_.draw(*item.skin, item.colour, canvas);
  glBindVertexArray(vertex_array_);
}

void GlesRenderer::build(const Scene& scene, float scale) {
  vertices_.clear();
  indices_.clear();
  batches_.clear();
  for (const SceneItem& item : scene.items()) {
    switch (item.kind) {
      case ItemKind::area:
        open_batch(Shape::plain, nullptr);
        add_rectangle(item);
        break;
      case ItemKind::image:
        if (!drawable(item.picture)) break;
        open_batch(Shape::textured, &item.picture);
        add_rectangle(item);
        break;
      case ItemKind::mesh:
        add_mesh(item);
        break;
      case ItemKind::lines:
        add_lines(item, scale);
        break;
      case ItemKind::points:
        add_points(item, scale);
        break;
    }
    if (!batches_.empty()) batches_.back().count = indices_.size() - batches_.back().first;
  }
}

void GlesRenderer::open_batch(Shape shape, const Picture* picture) {
  if (picture == nullptr && !batches_.empty() && batches_.back().shape == shape) return;
  batches_.push_back({shape, picture, indices_.size(), 0, nullptr});
}

// Two triangles over four vertices in the order of a strip.
void GlesRenderer::add_quad(uint32_t first_vertex) {
  for (const uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices_.push_back(first_vertex + corner);
}

void GlesRenderer::add_rectangle(const SceneItem& item) {
  const auto first = static_cast<uint32_t>(vertices_.size());
  Vertex vertex{};
  pack(item.colour, vertex.rgba);
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}}) {
    vertex.at = {item.at.x + corner.x * item.size.x, item.at.y + corner.y * item.size.y};
    vertex.uv = corner;
    vertices_.push_back(vertex);
  }
  add_quad(first);
}

void GlesRenderer::add_mesh(const SceneItem& item) {
  if (item.skin != nullptr && drawable(item.picture)) {
    open_batch(Shape::solid, &item.picture);
    batches_.back().skinned = &item;
    return;
  }
  const std::size_t count = item.positions.size();
  const bool plain = item.picture.pixels == nullptr && item.texcoords.empty();
  if (count == 0 || (!plain && (!drawable(item.picture) || item.texcoords.size() != count))) return;
  const bool solid = item.heights.size() == count && item.normals.size() == count;
  if (plain) open_batch(Shape::plain, nullptr);
  else open_batch(solid ? Shape::solid : Shape::textured, &item.picture);
  const auto first = static_cast<uint32_t>(vertices_.size());
  Vertex vertex{};
  pack(item.colour, vertex.rgba);
  for (std::size_t i = 0; i < count; ++i) {
    vertex.at = item.positions[i];
    if (!plain) vertex.uv = item.texcoords[i];
    vertices_.push_back(vertex);
  }
  if (solid) raise(item, first);
  for (std::size_t i = 0; i + 2 < item.indices.size(); i += 3) {
    const uint32_t a = item.indices[i], b = item.indices[i + 1], c = item.indices[i + 2];
    if (std::max({a, b, c}) >= count) continue;  // the GPU must not read past the vertices
    for (const uint32_t corner : {a, b, c}) indices_.push_back(first + corner);
  }
}

// The mesh's own heights fill the whole depth range: it is the only one in it.
void GlesRenderer::raise(const SceneItem& item, std::size_t first_vertex) {
  const auto [low, high] = std::minmax_element(item.heights.begin(), item.heights.end());
  const float middle = 0.5f * (*low + *high), half = std::max(0.51f * (*high - *low), 1e-6f);
  for (std::size_t i = 0; i < item.heights.size(); ++i) {
    Vertex& vertex = vertices_[first_vertex + i];
    vertex.depth = (middle - item.heights[i]) / half;
    const Vec3 n = item.normals[i];
    const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    const float unit = length > 0 ? 127.0f / length : 0.0f;
    vertex.normal[0] = static_cast<int8_t>(n.x * unit);
    vertex.normal[1] = static_cast<int8_t>(n.y * unit);
    vertex.normal[2] = static_cast<int8_t>(n.z * unit);
  }
}

// Points closer than half the thickness only make neighbouring joins overlap; the ends always stay.
void GlesRenderer::simplify(const SceneItem& item) {
  strip_.clear();
  const float step = std::max(0.5f * item.width_px, 0.1f);
  for (const Vec2 point : item.positions) {
    if (strip_.empty() || length(point - strip_.back()) >= step) strip_.push_back(point);
  }
  if (strip_.empty()) return;
  const Vec2 end = item.closed ? item.positions.front() : item.positions.back();
  if (strip_.size() > 1 && length(end - strip_.back()) < step) strip_.pop_back();
  if (strip_.size() > 1 || length(end - strip_.back()) > 0) strip_.push_back(end);
}

// One mitred band: a pair of vertices at each point, a second pair where the turn is too sharp for a mitre.
void GlesRenderer::add_lines(const SceneItem& item, float scale) {
  simplify(item);
  const std::size_t count = strip_.size();
  if (count < 2 || item.width_px <= 0) return;
  open_batch(Shape::band, nullptr);
  const float half = 0.5f * item.width_px;
  const float reach = std::max(half, 0.5f / scale) + soft_margin(scale);
  Vertex vertex{};
  pack(item.colour, vertex.rgba);
  vertex.edge_px = half;
  const auto add_pair = [&](Vec2 at, Vec2 across) {
    for (const float side : {-1.0f, 1.0f}) {
      vertex.at = at + side * reach * across;
      vertex.uv = {side * reach, 0};
      vertices_.push_back(vertex);
    }
  };
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool end = i == 0 || i + 1 == count;
    const std::size_t before = i > 0 ? i - 1 : (item.closed ? count - 2 : 0);
    const std::size_t after = i + 1 < count ? i + 1 : (item.closed ? 1 : i);
    const Vec2 in =
        end && !item.closed && i == 0 ? normalised(strip_[1] - strip_[0]) : normalised(strip_[i] - strip_[before]);
    const Vec2 out = end && !item.closed && i > 0 ? in : normalised(strip_[after] - strip_[i]);
    const Vec2 sum = right_of(in) + right_of(out);
    const float squared = length_sq(sum);  // 4 cos^2 of half the turn
    if (squared > 1.0f) {
      add_pair(strip_[i], sum * (2.0f / squared));
    } else {
      add_pair(strip_[i], right_of(in));
      add_pair(strip_[i], right_of(out));
    }
  }
  for (uint32_t v = first; v + 3 < vertices_.size(); v += 2) add_quad(v);
}

void GlesRenderer::add_points(const SceneItem& item, float scale) {
  if (item.positions.empty() || item.width_px <= 0) return;
  open_batch(Shape::disc, nullptr);
  const float radius = 0.5f * item.width_px;
  const float reach = std::max(radius, 0.5f / scale) + soft_margin(scale);
  Vertex vertex{};
  pack(item.colour, vertex.rgba);
  vertex.edge_px = radius;
  for (const Vec2 centre : item.positions) {
    const auto first = static_cast<uint32_t>(vertices_.size());
    for (const Vec2 corner : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
      vertex.uv = corner * reach;
      vertex.at = centre + vertex.uv;
      vertices_.push_back(vertex);
    }
    add_quad(first);
  }
}

// A buffer is given up to the driver before it is written again, so that a frame still being drawn does not stall us.
void GlesRenderer::upload_buffers() {
  const auto stream = [](unsigned target, std::size_t& capacity, std::size_t bytes, const void* data) {
    capacity = std::max(capacity, bytes);
    glBufferData(target, static_cast<GLsizeiptr>(capacity), nullptr, GL_STREAM_DRAW);
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes), data);
  };
  if (vertices_.empty()) return;
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
  stream(GL_ARRAY_BUFFER, vertex_bytes_, vertices_.size() * sizeof(Vertex), vertices_.data());
  stream(GL_ELEMENT_ARRAY_BUFFER, index_bytes_, indices_.size() * sizeof(uint32_t), indices_.data());
}

GlesRenderer::Texture& GlesRenderer::slot(uint32_t id) {
  for (Texture& texture : textures_) {
    if (texture.id == id) return texture;
  }
  textures_.push_back({id, 0, 0, 0, PixelFormat::luma8, 0});
  glGenTextures(1, &textures_.back().handle);
  return textures_.back();
}

void GlesRenderer::bind_texture(const Picture& picture) {
  Texture& texture = slot(picture.id);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture.handle);
  const bool fresh =
      texture.width != picture.width || texture.height != picture.height || texture.format != picture.format;
  if (!fresh && texture.revision == picture.revision) return;
  upload(picture, fresh);
  texture.width = picture.width, texture.height = picture.height;
  texture.format = picture.format, texture.revision = picture.revision;
}

// Drawings (rgba8) are premultiplied, and get mipmaps because they are shown smaller than they are and rarely change;
// camera frames (luma8, rgb8) change every time and are shown near their own size.
void GlesRenderer::upload(const Picture& picture, bool fresh) {
  const GlFormat format = gl_format(picture.format);
  const bool drawing = picture.format == PixelFormat::rgba8;
  if (fresh) {
    int largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (picture.width > largest || picture.height > largest) {
      throw UserError("a picture of " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                      " pixels is larger than this GPU can show (" + std::to_string(largest) + "); make it smaller");
    }
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<int>(format.internal), picture.width, picture.height, 0, format.external,
                 GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, drawing ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    const int green_blue = picture.format == PixelFormat::luma8 ? GL_RED : 0;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, green_blue != 0 ? green_blue : GL_GREEN);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, green_blue != 0 ? green_blue : GL_BLUE);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width, picture.height, format.external, GL_UNSIGNED_BYTE,
                  packed(picture, static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(format.bytes)));
  if (drawing) glGenerateMipmap(GL_TEXTURE_2D);
}

// Its rows without gaps: the stride need not be a whole number of pixels, which GL_UNPACK_ROW_LENGTH would ask for. A camera's
// picture mostly has none, and is half a megabyte that need not be copied.
const uint8_t* GlesRenderer::packed(const Picture& picture, std::size_t row_bytes) {
  const bool drawing = picture.format == PixelFormat::rgba8;
  if (!drawing && static_cast<std::size_t>(picture.stride) == row_bytes) return picture.pixels;
  staging_.resize(row_bytes * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    const uint8_t* from = picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride;
    uint8_t* to = staging_.data() + static_cast<std::size_t>(y) * row_bytes;
    std::copy_n(from, row_bytes, to);
    if (!drawing) continue;
    for (std::size_t i = 0; i < row_bytes; i += 4) {
      for (std::size_t k = 0; k < 3; ++k) to[i + k] = static_cast<uint8_t>((to[i + k] * to[i + 3] + 127) / 255);
    }
  }
  return staging_.data();
}

}  // namespace nt
