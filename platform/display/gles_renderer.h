// SPDX-License-Identifier: Apache-2.0
// Draws a Scene with OpenGL ES 3.0 into the framebuffer that is bound; the same picture in a window and off-screen.
//
// Scene (pixels, x right, y down, origin at the canvas' corner) + framebuffer size -> canvas scaled to fit with its aspect
// kept, black bars beside it, nothing drawn outside it. Lines and points are scaled with the canvas and have soft edges
// one display pixel wide. Blending is premultiplied, so transparent texels do not darken the edge of a drawing.
// A mesh with heights is drawn with depth among its own triangles, both sides of each, lit softly from the upper left by its
// normals; texels less than half opaque are left out, because depth knows no half.
// The framebuffer needs a depth buffer for that. A texture is kept for each Picture.id until the renderer goes; pixels are read again when revision, size or format change.
// Cost: one vertex and one index upload a frame, one draw call for each run of items with the same texture; the
// buffers grow to the largest scene seen and stay, so a steady scene allocates nothing.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "platform/display/canvas_fit.h"
#include "platform/display/gles_program.h"
#include "platform/display/lattice_mesh.h"

namespace nt {

enum class RowOrder : uint8_t { bottom_up, top_down };  // of the framebuffer: a window's is bottom_up

class GlesRenderer {
 public:
  // A GLES 3.0 context must be current here, in draw() and in the destructor. Throws UserError when a shader fails.
  GlesRenderer();
  ~GlesRenderer();
  GlesRenderer(const GlesRenderer&) = delete;
  GlesRenderer& operator=(const GlesRenderer&) = delete;

  void draw(const Scene& scene, int display_width, int display_height, RowOrder rows);
  static std::string description();  // GL_RENDERER and GL_VERSION of the current context

 private:
  // Textured: u, v in [0, 1]. Band and disc: distance from the middle in scene pixels, and where the edge is.
  struct Vertex {
    Vec2 at;
    Vec2 uv;
    float edge_px;
    float depth;  // -1 nearest to the viewer, 1 farthest
    int8_t normal[4];
    uint8_t rgba[4];
  };
  struct Batch {
    Shape shape;
    const Picture* picture;
    std::size_t first, count;  // of indices_
    const SceneItem* skinned;  // drawn by skins_ in place of them
  };
  struct Texture {
    uint32_t id;
    unsigned handle;
    int width, height;
    PixelFormat format;
    uint64_t revision;
  };

  void build(const Scene& scene, float scale);
  void add_rectangle(const SceneItem& item);
  void add_mesh(const SceneItem& item);
  void use(Shape shape, const float* canvas, float scale);
  void draw_skin(const SceneItem& item, const float* canvas);
  void raise(const SceneItem& item, std::size_t first_vertex);
  void add_lines(const SceneItem& item, float scale);
  void add_points(const SceneItem& item, float scale);
  void add_quad(uint32_t first_vertex);
  void open_batch(Shape shape, const Picture* picture);
  void simplify(const SceneItem& item);
  void upload_buffers();
  void bind_texture(const Picture& picture);
  void upload(const Picture& picture, bool fresh);
  const uint8_t* packed(const Picture& picture, std::size_t row_bytes);
  Texture& slot(uint32_t id);

  struct Program {
    unsigned handle = 0;
    int canvas = -1, scale = -1;  // uniforms
  };
  std::array<Program, kShapes> programs_;
  unsigned vertex_array_ = 0, vertex_buffer_ = 0, index_buffer_ = 0;
  std::size_t vertex_bytes_ = 0, index_bytes_ = 0;  // capacity on the GPU
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> indices_;
  std::vector<Batch> batches_;
  std::vector<Vec2> strip_;
  std::vector<Texture> textures_;
  std::vector<uint8_t> staging_;
  LatticeMeshes skins_;
};

}  // namespace nt
