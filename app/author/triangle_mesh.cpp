// SPDX-License-Identifier: Apache-2.0
#include "app/author/triangle_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <map>
#include <tuple>

#include "app/codecs/gltf_check.h"
#include "platform/camera.h"

namespace nt {
namespace {

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, TriangleMesh& out,
              std::map<std::tuple<float, float, float>, uint32_t>& known) {
  const aiMatrix4x4 place = above * node.mTransformation;
  const std::string name = node.mName.C_Str();
  // Helper geometry of modelling programs: skirts, joint markers.
  const bool helper = name.rfind("helper", 0) == 0 || name.rfind("joint", 0) == 0;
  for (unsigned m = 0; m < node.mNumMeshes && !helper; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    std::vector<uint32_t> number;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = place * mesh.mVertices[v];
      const auto [it, is_new] = known.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(out.positions.size()));
      if (is_new) out.positions.push_back({p.x, p.y, p.z});
      number.push_back(it->second);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      for (unsigned k = 0; k < 3; ++k) out.triangles.push_back(number[mesh.mFaces[f].mIndices[k]]);
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) add_node(scene, *node.mChildren[c], place, out, known);
}

}  // namespace

TriangleMesh read_triangles_file(const std::string& path) {
  check_gltf(path);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw UserError("cannot read the mesh " + path + ": " + importer.GetErrorString());
  }
  TriangleMesh out;
  std::map<std::tuple<float, float, float>, uint32_t> known;
  add_node(*scene, *scene->mRootNode, aiMatrix4x4(), out, known);
  if (out.triangles.empty()) throw UserError(path + " has no triangle in it");
  return out;
}

}  // namespace nt
