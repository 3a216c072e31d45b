// SPDX-License-Identifier: Apache-2.0
// A 3D character moved by its lattice: the control points that Retarget has posed -> vertices, heights, normals.
//
// Input: the control points in character units and the local frame (x right, y to the head), in Retarget's order; each is a
// marker of the lattice at the height that it has at rest (core/character/character.h, LatticeDrive::landmarks). The midline
// is the lattice's skeleton, so bones keep their lengths and the body its volume. Output: place and normal of every
// vertex, in the same frame; normals not of unit length.
// Source: [L] for the lattice (core/deform/lattice.h), James 2020 for the embedding; a normal turns by the rotations of its
// tetrahedron's corners, mixed by its weights in it.
// Memory: the lattice's and the embedding's, 12 bytes a vertex and 16 a control point. Cost: about 0.6 ms for 450 lattice
// vertices and 6,000 vertices.
#pragma once
#include <span>

#include "core/base/arena.h"
#include "core/base/vec2.h"
#include "core/character/character.h"
#include "core/deform/lattice.h"

namespace nt {

class LatticePose {
 public:
  // Whether the character's lattice was made for these control points at rest.
  static bool fits(const Character& character, std::span<const Vec2> rest_handles);
  // Null when the arena is measuring or full. The character's bytes must outlive it.
  static LatticePose* create(Arena& arena, const Character& character);

  void reset() { lattice_->reset(); }
  // Without `vertices` a renderer places them: see pack.
  LatticeReport pose(std::span<const Vec2> handles, bool vertices = true);
  // What a vertex shader needs to place them (core/scene/scene.h, LatticeSkin): 12 floats for each lattice vertex.
  void pack(std::span<float> out) { embedding_->pack(lattice_->vertices(), out); }

  Vec3 place(std::size_t vertex) const {
    const float* p = &places_[3u * character_.lattice.slots[vertex]];
    return {p[0], p[1], p[2]};
  }
  Vec3 normal(std::size_t vertex) const;
  const Lattice& lattice() const { return *lattice_; }

 private:
  Character character_;
  Lattice* lattice_ = nullptr;
  PhongEmbedding* embedding_ = nullptr;
  std::span<Vec3> markers_;  // z as at rest
  std::span<uint8_t> seen_;
  std::span<float> places_;  // 3 a slot
};

}  // namespace nt
