// SPDX-License-Identifier: Apache-2.0
// Draws LatticeSkins (core/scene/scene.h): the vertex shader places every mesh vertex by its tetrahedron, linearly or by Phong.
//
// Kept on the GPU: corners, weights, texture coordinates, normals, indices. Sent each frame: the lattice alone, one float
// texture with 12 values a lattice vertex (21 KB for 450), whatever the mesh. Source: James, "Phong deformation", 2020, written per
// corner so that a vertex needs nothing of its neighbours: x' = sum b_k (x_k' + 1/2 F_k (X - X_k)), X = sum b_k X_k, which is
// the same as core/deform/embed.h's sum over edges. A normal turns by sum b_k F_k.
// A GLES 3.0 context must be current in every call. Throws UserError when a shader fails.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

class LatticeMeshes {
 public:
  LatticeMeshes() = default;
  ~LatticeMeshes();
  LatticeMeshes(const LatticeMeshes&) = delete;
  LatticeMeshes& operator=(const LatticeMeshes&) = delete;

  // With the program's own uniforms set; the texture with the picture is bound to unit 0. canvas: scale and offset from scene
  // pixels to clip space.
  void draw(const LatticeSkin& skin, const Colour& tint, const float canvas[4]);
  // x, y, z of every mesh vertex in the rest frame's unit, as the shader has them: for tests.
  std::vector<float> places(const LatticeSkin& skin);

  static std::size_t bytes_each_frame(const LatticeSkin& skin) {
    return skin.rest.size() * kTexels * 4 * sizeof(float);
  }

 private:
  static constexpr std::size_t kTexels = 3;  // a lattice vertex: place and F, 12 floats
  struct Mesh {
    uint32_t id = 0;
    uint64_t revision = 0;
    unsigned vertex_array = 0, buffers[3] = {}, textures[2] = {};
    int indices = 0, vertices = 0;
  };
  void start();
  Mesh& slot(const LatticeSkin& skin);
  void upload(Mesh& mesh, const LatticeSkin& skin);
  void prepare(const LatticeSkin& skin, const Mesh& mesh);

  unsigned program_ = 0;
  int canvas_ = -1, frame_ = -1, depth_ = -1, tint_ = -1, phong_ = -1;
  std::vector<Mesh> meshes_;
  std::vector<float> staging_;
};

}  // namespace nt
