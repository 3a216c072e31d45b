// SPDX-License-Identifier: Apache-2.0
// Meshes are read by Assimp, which comes with libneontetra_codecs.so when the first one is asked for.
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "app/author/mesh_file.h"
#include "app/author/triangle_mesh.h"
#include "platform/codecs.h"

namespace nt {

bool is_mesh_file(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".glb" || ending == ".gltf" || ending == ".obj" || ending == ".ply";
}

SourceMesh read_mesh(const std::string& path, const ToldAxes& told) {
  using Read = void (*)(const std::string&, const ToldAxes&, SourceMesh&);
  static const auto read = reinterpret_cast<Read>(codecs_function("neontetra_read_mesh"));
  SourceMesh mesh;
  read(path, told, mesh);
  return mesh;
}

TriangleMesh read_triangles(const std::string& path) {
  using Read = void (*)(const std::string&, TriangleMesh&);
  static const auto read = reinterpret_cast<Read>(codecs_function("neontetra_read_triangles"));
  TriangleMesh mesh;
  read(path, mesh);
  return mesh;
}

}  // namespace nt
