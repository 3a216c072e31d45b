// SPDX-License-Identifier: Apache-2.0
// What to draw, without any GL: a fixed list of items in painting order that every renderer shows the same way.
//
// Frame of reference: scene pixels, x right, y down, origin at the top left corner of the canvas; the renderer scales the
// canvas to the display and keeps its aspect. Items cover those before them; only within a mesh that has heights (scene
// pixels towards the viewer) what is higher hides what is lower, and it is lit from above, a little from the left. Colours are RGBA in [0, 1], not premultiplied.
// The scene owns nothing: spans and pixels must live until the renderer has drawn it.
// Cost: filling is a few stores per item; no allocation, kMaxItems items.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/base/vec2.h"
#include "core/base/vec3.h"

namespace nt {

struct Colour {
  float r = 1, g = 1, b = 1, a = 1;
};

enum class PixelFormat : uint8_t { luma8, rgb8, rgba8 };

// A picture to show. `id` names a texture slot that the renderer keeps; pixels are uploaded again when `revision` changes.
struct Picture {
  const uint8_t* pixels = nullptr;
  int width = 0, height = 0;
  int stride = 0;  // bytes from one row to the next
  PixelFormat format = PixelFormat::luma8;
  uint32_t id = 0;
  uint64_t revision = 0;
};

// A mesh inside a control lattice (core/deform/embed.h), placed by the renderer: from one frame to the next only the lattice
// changes. The first part is kept by the renderer under `id` and read again when `revision` changes.
struct LatticeSkin {
  uint32_t id = 0;
  uint64_t revision = 0;
  std::span<const uint16_t> corners;  // four lattice vertices for each mesh vertex
  std::span<const float> weights;     // of the corners 1, 2, 3: three for each mesh vertex
  std::span<const Vec3> rest;         // lattice vertices at rest, with x right, y up, z towards the viewer
  std::span<const Vec3> normals;      // of the mesh vertices at rest
  std::span<const Vec2> texcoords;
  std::span<const uint32_t> triangles;
  float low = 0, high = 1;  // heights of the mesh at rest
  // Each frame, for each lattice vertex: its place and the columns of its deformation gradient, 12 floats.
  std::span<const float> lattice;
  bool phong = true;  // else linear
  Vec2 origin, up;    // scene pixels: where the rest frame's origin lies, and its y, as long as one unit
};

enum class ItemKind : uint8_t { area, image, mesh, lines, points };

struct SceneItem {
  ItemKind kind = ItemKind::image;
  Picture picture;                    // image, mesh; a mesh without pixels and texcoords is of one colour
  Vec2 at, size;                      // area, image: top left corner and extent
  std::span<const Vec2> positions;    // mesh: vertices; lines: a strip; points: centres
  std::span<const Vec2> texcoords;    // mesh: in [0, 1], v down, one per vertex
  std::span<const uint32_t> indices;  // mesh: three per triangle
  std::span<const float> heights;     // mesh: one per vertex, or none for a flat one
  std::span<const Vec3> normals;      // mesh with heights: one per vertex, z towards the viewer, of any length
  Colour colour;                      // area, lines, points; multiplies images and meshes
  float width_px = 1;                 // lines: thickness; points: diameter
  bool closed = false;                // lines: join the last to the first
  const LatticeSkin* skin = nullptr;  // mesh: in place of positions to normals
};

inline constexpr int kMaxItems = 256;

class Scene {
 public:
  void clear(int width, int height, Colour background) {
    width_ = width, height_ = height, background_ = background, count_ = 0, dropped_ = 0;
  }
  void add(const SceneItem& item) {
    if (count_ < kMaxItems) items_[static_cast<std::size_t>(count_++)] = item;
    else ++dropped_;
  }
  void area(Vec2 at, Vec2 size, Colour colour) {
    SceneItem item;
    item.kind = ItemKind::area, item.at = at, item.size = size, item.colour = colour;
    add(item);
  }
  void image(const Picture& picture, Vec2 at, Vec2 size, Colour tint = {}) {
    SceneItem item;
    item.kind = ItemKind::image, item.picture = picture, item.at = at, item.size = size, item.colour = tint;
    add(item);
  }
  void mesh(const Picture& texture, std::span<const Vec2> positions, std::span<const Vec2> texcoords,
            std::span<const uint32_t> indices, Colour tint = {}) {
    SceneItem item;
    item.kind = ItemKind::mesh, item.picture = texture, item.positions = positions, item.texcoords = texcoords;
    item.indices = indices, item.colour = tint;
    add(item);
  }
  void plain(std::span<const Vec2> positions, std::span<const uint32_t> indices, Colour colour) {
    mesh({}, positions, {}, indices, colour);
  }
  void solid(const Picture& texture, std::span<const Vec2> positions, std::span<const float> heights,
             std::span<const Vec3> normals, std::span<const Vec2> texcoords, std::span<const uint32_t> indices,
             Colour tint = {}) {
    SceneItem item;
    item.kind = ItemKind::mesh, item.picture = texture, item.positions = positions, item.heights = heights;
    item.normals = normals, item.texcoords = texcoords, item.indices = indices, item.colour = tint;
    add(item);
  }
  void solid(const Picture& texture, const LatticeSkin& skin, Colour tint = {}) {
    SceneItem item;
    item.kind = ItemKind::mesh, item.picture = texture, item.skin = &skin, item.colour = tint;
    add(item);
  }
  void lines(std::span<const Vec2> strip, Colour colour, float width_px, bool closed = false) {
    SceneItem item;
    item.kind = ItemKind::lines, item.positions = strip, item.colour = colour, item.width_px = width_px;
    item.closed = closed;
    add(item);
  }
  void points(std::span<const Vec2> centres, Colour colour, float diameter_px) {
    SceneItem item;
    item.kind = ItemKind::points, item.positions = centres, item.colour = colour, item.width_px = diameter_px;
    add(item);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  Colour background() const { return background_; }
  int dropped() const { return dropped_; }  // items that did not fit: raise kMaxItems
  std::span<const SceneItem> items() const { return {items_.data(), static_cast<std::size_t>(count_)}; }

 private:
  std::array<SceneItem, kMaxItems> items_{};
  int count_ = 0;
  int dropped_ = 0;
  int width_ = 0, height_ = 0;
  Colour background_;
};

}  // namespace nt
