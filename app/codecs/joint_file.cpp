// SPDX-License-Identifier: Apache-2.0
#include "app/codecs/joint_file.h"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <map>

#include "app/codecs/gltf_check.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr std::size_t kMostJoints = 2000;
constexpr uintmax_t kMostBytes = 256u << 20;

Vec3 origin_of(const aiMatrix4x4& m) { return {m.a4, m.b4, m.c4}; }

class JointReader {
 public:
  explicit JointReader(const std::string& path) : path_(path) {}

  SkeletonSpec read() {
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path_, error);
    if (error) throw UserError("cannot read " + path_ + "; is the name right?");
    if (size > kMostBytes) throw UserError(path_ + ": more than 256 MB is no skeleton");
    check_gltf(path_);
    const aiScene& scene = import();
    find_bones(*scene.mRootNode, {}, scene);
    if (bones_.empty() && scene.mNumMeshes > 0) throw UserError(path_ + " has no skin, so it has no joints");
    walk(*scene.mRootNode, {}, -1);
    if (out_.joints.size() < 2) throw UserError(path_ + " has no bone in it");
    return out_;
  }

 private:
  const aiScene& import() {
    importer_.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    const aiScene* scene = nullptr;
    try {
      scene = importer_.ReadFile(path_, 0);
    } catch (const std::exception&) {
      scene = nullptr;
    }
    if (scene == nullptr || scene->mRootNode == nullptr) {
      std::string why = importer_.GetErrorString();
      std::replace_if(
          why.begin(), why.end(), [](unsigned char c) { return c < 32; }, ' ');
      throw UserError("cannot read joints from " + path_ + (why.empty() ? "" : ": " + why.substr(0, 160)));
    }
    return *scene;
  }

  // A skin's vertices do not move with the node of their mesh, but read_triangles lets them, so the joints do, too.
  void find_bones(const aiNode& node, const aiMatrix4x4& above, const aiScene& scene) {
    const aiMatrix4x4 place = above * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
      for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        aiMatrix4x4 bind = mesh.mBones[b]->mOffsetMatrix;
        bones_.try_emplace(mesh.mBones[b]->mName.C_Str(), origin_of(place * bind.Inverse()));
      }
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) find_bones(*node.mChildren[c], place, scene);
  }

  void walk(const aiNode& node, const aiMatrix4x4& above, int parent) {
    const aiMatrix4x4 place = above * node.mTransformation;
    const auto bone = bones_.find(node.mName.C_Str());
    if (bones_.empty() || bone != bones_.end()) {
      parent = add(node.mName.C_Str(), bones_.empty() ? origin_of(place) : bone->second, parent);
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) walk(*node.mChildren[c], place, parent);
  }

  int add(std::string name, Vec3 at, int parent) {
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
      throw UserError(path_ + ": a joint's place is not a number");
    }
    if (parent >= 0 &&
        length(at - out_.joints[static_cast<std::size_t>(parent)].position) < 1e-6f * (1.0f + length(at))) {
      return parent;
    }
    if (out_.joints.size() == kMostJoints) throw UserError(path_ + ": more than 2000 joints");
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= 32; }, '_');
    out_.joints.push_back({name, parent, at, {}});
    return static_cast<int>(out_.joints.size()) - 1;
  }

  std::string path_;
  Assimp::Importer importer_;
  std::map<std::string, Vec3> bones_;  // of all skins, where they bind
  SkeletonSpec out_;
};

}  // namespace

SkeletonSpec read_joint_file(const std::string& path) { return JointReader(path).read(); }

}  // namespace nt
