// SPDX-License-Identifier: Apache-2.0
// A mesh file (glTF, GLB, OBJ, PLY) -> one list of triangles with one texture. Off the frame path.
//
// Input: whatever Assimp reads. Output: vertices laid down (mesh_axes.h: x right, y forward, z up) in
// the file's unit, texture coordinates (v down) and one RGBA
// picture: the textures of all materials side by side, or vertex colours painted from above and below, or the materials'
// plain colours. Helper geometry (groups named helper*, joint*) is left out. Triangles with numbers that are none, without area,
// or named twice are dropped; what was done is said in `notes`, one line each.
// Errors: UserError with one line: missing, not a mesh, empty, flat beyond use, too large.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "app/author/mesh_axes.h"
#include "core/base/vec2.h"
#include "core/base/vec3.h"

namespace nt {

struct SourceMesh {
  std::vector<Vec3> positions;
  std::vector<Vec2> texcoords;
  std::vector<uint32_t> triangles;
  cv::Mat texture;  // 8UC4 RGBA
  MeshAxes axes;    // how it was laid down
  int parts = 0;    // of the file, helpers left out
  std::vector<std::string> notes;
};

// By the name's ending: .glb, .gltf, .obj, .ply, in either case.
bool is_mesh_file(const std::string& path);

// The same, inside libneontetra_codecs.so (platform/codecs.h).
SourceMesh read_mesh_file(const std::string& path, const ToldAxes& told);

SourceMesh read_mesh(const std::string& path, const ToldAxes& told);

}  // namespace nt
