// SPDX-License-Identifier: Apache-2.0
// `neontetra markers --out FILE.glb`, read back by Assimp, which knows nothing of us: its skin puts the vertices where the
// report says, and what it says is near; and skeletons from files with joints.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/author/skeleton_file.h"
#include "app/author/triangle_mesh.h"
#include "core/base/random.h"
#include "platform/camera.h"
#include "tests/app/mesh_text.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

constexpr int kFrames = 12;

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

class MeshRecordingCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(mesh_) << fish_obj().text;
    std::ofstream csv(recording_);
    csv << "nose_x,nose_y,nose_z,side_x,side_y,side_z,back_x,back_y,back_z,rear_x,rear_y,rear_z\n";
    const double place[4][3] = {{0.95, 0, 0}, {0.3, 0, 0.2}, {0.3, 0.25, 0}, {-0.6, 0, 0}};
    for (int f = 0; f < kFrames; ++f) {
      for (int m = 0; m < 4; ++m) {
        const double sway = f * 0.02 * place[m][0] * place[m][0];
        csv << (m ? "," : "") << place[m][0] << "," << place[m][1] << "," << place[m][2] + sway;
      }
      csv << "\n";
    }
  }
  TempDir dir_;
  const std::string mesh_ = dir_ / "fish.obj", recording_ = dir_ / "swim.csv", glb_ = dir_ / "swim.glb",
                    table_ = dir_ / "swim-lattice.csv";
};

// The vertices as bones and keys of one frame put them.
std::vector<aiVector3D> skinned(const aiScene& scene, unsigned frame) {
  std::map<std::string, aiMatrix4x4> place;
  for (unsigned c = 0; c < scene.mAnimations[0]->mNumChannels; ++c) {
    const aiNodeAnim& keys = *scene.mAnimations[0]->mChannels[c];
    const auto turn = keys.mRotationKeys[keys.mNumRotationKeys > 1 ? frame : 0].mValue;
    const auto at = keys.mPositionKeys[keys.mNumPositionKeys > 1 ? frame : 0].mValue;
    place[keys.mNodeName.C_Str()] = aiMatrix4x4({1, 1, 1}, turn, at);
  }
  const aiMesh& mesh = *scene.mMeshes[0];
  std::vector<aiVector3D> out(mesh.mNumVertices);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const auto keyed = place.find(bone.mName.C_Str());
    const aiMatrix4x4 moved = keyed == place.end() ? aiMatrix4x4() : keyed->second * bone.mOffsetMatrix;
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      const unsigned v = bone.mWeights[w].mVertexId;
      out[v] += bone.mWeights[w].mWeight * (moved * mesh.mVertices[v]);
    }
  }
  return out;
}

TEST_F(MeshRecordingCommand, AnotherReaderSeesTheSameMotion) {
  const Outcome run = neontetra("markers " + recording_ + " --mesh " + mesh_ + " --axes x,y,z --vertices 300 --out " +
                                glb_ + " --out " + table_ + " --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["glb"]["keys"], kFrames);
  EXPECT_EQ(json["glb"]["joints"], 1 + json["lattice"]["vertices"].get<int>());
  EXPECT_LT(json["glb"]["error_most"].get<double>(), 0.01);
  EXPECT_GT(json["glb"]["error_most"].get<double>(), 0.0);
  const std::string table = text_of(table_);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), kFrames + 1);

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(glb_, aiProcess_ValidateDataStructure);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumAnimations, 1u);
  const std::vector<aiVector3D> first = skinned(*scene, 0), last = skinned(*scene, kFrames - 1);
  ASSERT_EQ(first.size(), json["lattice"]["mesh_vertices"].get<std::size_t>());
  // Nose and tail sway aside by the square of their place, as the markers do.
  const auto moved = [&](auto better) {
    const auto at = std::max_element(first.begin(), first.end(), [&](auto& a, auto& b) { return better(b.x, a.x); });
    return last[static_cast<std::size_t>(at - first.begin())].z - at->z;
  };
  const float most = (kFrames - 1) * 0.02f;
  EXPECT_NEAR(moved([](float a, float b) { return a > b; }), most, 0.15f * most);
  EXPECT_LT(moved([](float a, float b) { return std::abs(a - 0.3f) < std::abs(b - 0.3f); }), 0.5f * most);

  // The same file as a skeleton: as many joints as the lattice has vertices that move a vertex of the mesh.
  const SkeletonSpec skeleton = read_skeleton(glb_);
  EXPECT_GT(skeleton.joints.size(), 100u);
  EXPECT_LE(skeleton.joints.size(), 1u + json["lattice"]["vertices"].get<std::size_t>());
}

TEST_F(MeshRecordingCommand, TwoOfAKindAreRefused) {
  const Outcome run =
      neontetra("markers " + recording_ + " --mesh " + mesh_ + " --out " + glb_ + " --out " + (dir_ / "b.glb"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.error_lines(), 1) << run.err;
  EXPECT_NE(run.err.find("same kind"), std::string::npos) << run.err;
}

const char* const kBvh =
    "HIERARCHY\nROOT hips\n{\n  OFFSET 1 2 3\n  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
    "Yrotation\n"
    "  JOINT knee\n  {\n    OFFSET 0 -4 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "    End Site\n    {\n      OFFSET 0 -3 1\n    }\n  }\n}\n"
    "MOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0 0 0 0\n";

TEST(SkeletonFile, ABvhGivesItsJointsByItsOffsets) {
  const TempDir dir;
  const std::string path = dir / "leg.bvh";
  std::ofstream(path) << kBvh;
  const SkeletonSpec skeleton = read_skeleton(path);
  ASSERT_EQ(skeleton.joints.size(), 3u);
  EXPECT_EQ(skeleton.joints[0].name, "hips");
  EXPECT_EQ(skeleton.joints[0].parent, -1);
  EXPECT_EQ(skeleton.joints[1].parent, 0);
  EXPECT_EQ(skeleton.joints[2].parent, 1);
  EXPECT_LT(length(skeleton.joints[1].position - Vec3{1, -2, 3}), 1e-5f);
  EXPECT_LT(length(skeleton.joints[2].position - Vec3{1, -5, 4}), 1e-5f);
}

template <class T>
void put(std::string& bytes, std::initializer_list<T> values) {
  for (const T v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
}

std::string glb_of(std::string json, const std::string& binary) {
  while (json.size() % 4 != 0) json += ' ';
  std::string out = "glTF";
  const auto size = [](const std::string& s) { return static_cast<uint32_t>(s.size()); };
  put<uint32_t>(out, {2, 28 + size(json) + size(binary), size(json)});
  out += "JSON" + json;
  put<uint32_t>(out, {size(binary), 0x004e4942});
  return out + binary;
}

// A leg: two triangles on three joints, one above the other.
const char* const kLegJson =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],"nodes":[{"name":"hip","children":[1]},)"
    R"({"name":"knee","translation":[0,1,0],"children":[2]},{"name":"foot","translation":[0,1,0]},{"name":"leg","mesh":0,"skin":0}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]}],)"
    R"("skins":[{"joints":[0,1,2],"inverseBindMatrices":4,"skeleton":0}],"buffers":[{"byteLength":332}],"bufferViews":[)"
    R"({"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":16},)"
    R"({"buffer":0,"byteOffset":64,"byteLength":64},{"buffer":0,"byteOffset":128,"byteLength":12},)"
    R"({"buffer":0,"byteOffset":140,"byteLength":192}],"accessors":[)"
    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,2,0]},)"
    R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"},)"
    R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":3,"type":"MAT4"}]})";

std::string leg_binary() {
  std::string b;
  put<float>(b, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0});
  put<uint8_t>(b, {0, 1, 0, 0, 1, 2, 0, 0, 2, 0, 0, 0, 0, 1, 2, 0});
  put<float>(b, {.5f, .5f, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0, .4f, .3f, .3f, 0});
  put<uint16_t>(b, {0, 1, 2, 1, 2, 3});
  for (const float height : {0.0f, 1.0f, 2.0f}) put<float>(b, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -height, 0, 1});
  return b;
}

// The file with some of its numbers, bytes or its length changed.
std::string damaged_leg(Random& random) {
  const auto below = [&](std::size_t n) { return random.below(static_cast<uint32_t>(n)); };
  std::string json = kLegJson, binary = leg_binary();
  const uint32_t kind = random.below(4), changes = 1 + random.below(4);
  const char* const numbers[] = {"-1", "0", "3", "99", "65535", "4294967295", "1e99", "null", "\"x\"", "[]", "5126"};
  for (uint32_t k = 0; k < changes && kind == 0; ++k) {
    std::size_t at = below(json.size());
    while (at < json.size() && (std::isdigit(json[at]) == 0 || json[at - 1] == '_')) ++at;
    if (at < json.size()) json.replace(at, 1, numbers[below(std::size(numbers))]);
  }
  for (uint32_t k = 0; k < changes && kind == 1; ++k) json[below(json.size())] = static_cast<char>(random.below(256));
  for (uint32_t k = 0; k < changes && kind == 2; ++k)
    binary[below(binary.size())] = static_cast<char>(random.below(256));
  std::string glb = glb_of(json, binary);
  for (uint32_t k = 0; k < changes && kind == 3; ++k) glb[below(24)] = static_cast<char>(random.below(256));
  if (kind == 3 && changes > 2) glb.resize(below(glb.size()));
  return glb;
}

std::string refusal_of(const std::string& path) {
  try {
    EXPECT_GE(read_skeleton(path).joints.size(), 2u);
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

TEST(SkeletonFile, DamagedSkinsAreReadOrRefusedWithOneLine) {
  const TempDir dir;
  const std::string path = dir / "leg.glb";
  std::ofstream(path, std::ios::binary) << glb_of(kLegJson, leg_binary());
  ASSERT_EQ(read_skeleton(path).joints.size(), 3u);
  EXPECT_LT(length(read_skeleton(path).joints[2].position - Vec3{0, 2, 0}), 1e-5f);
  Random random(6);
  int refused = 0, rounds = 600;
  for (int round = 0; round < rounds; ++round) {
    std::ofstream(path, std::ios::binary) << damaged_leg(random);
    refused += !refusal_of(path).empty();
  }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, rounds - 100);
}

// What Assimp crashes on, or reads for minutes, as a skeleton and as a mesh.
TEST(SkeletonFile, WhatTheReaderWouldTrustIsLookedAtFirst) {
  const TempDir dir;
  const std::string path = dir / "leg.glb";
  std::string json = kLegJson;
  json.replace(json.find("\"inverseBindMatrices\":4,"), 24, "");
  std::ofstream(path, std::ios::binary) << glb_of(json, leg_binary());
  EXPECT_NE(refusal_of(path).find("inverseBindMatrices"), std::string::npos);
  EXPECT_THROW(read_triangles(path), UserError);
  for (const char* wrong : {"null", "-1", "1.5", "\"x\"", "99", "0"}) {
    json = kLegJson;
    json.replace(json.find("Matrices\":4") + 10, 1, wrong);
    std::ofstream(path, std::ios::binary) << glb_of(json, leg_binary());
    EXPECT_NE(refusal_of(path).find("inverseBindMatrices"), std::string::npos) << wrong;
  }
  json = kLegJson;
  json.replace(json.find("\"count\":3,\"type\":\"MAT4"), 9, "\"count\":1");
  std::ofstream(path, std::ios::binary) << glb_of(json, leg_binary());
  EXPECT_NE(refusal_of(path).find("inverseBindMatrices"), std::string::npos);
  json = kLegJson;
  json.insert(json.size() - 1, ",\"extras\":" + std::string(100'000, '[') + std::string(100'000, ']'));
  std::ofstream(path, std::ios::binary) << glb_of(json, leg_binary());
  EXPECT_NE(refusal_of(path).find("damaged"), std::string::npos);
  std::ofstream(path, std::ios::binary) << glb_of(kLegJson, leg_binary()) << "\0\0\0";  // padding
  EXPECT_EQ(refusal_of(path), "");
  std::string glb = glb_of(kLegJson, leg_binary());
  glb[15] = '\x70';
  std::ofstream(path, std::ios::binary) << glb;
  EXPECT_NE(refusal_of(path).find("cut short"), std::string::npos);
  EXPECT_THROW(read_triangles(path), UserError);
}

// Bytes changed and cut at random: joints or one line.
TEST(SkeletonFile, DamagedFilesAreReadOrRefusedWithOneLine) {
  const TempDir dir;
  const std::string path = dir / "leg.bvh", good = kBvh;
  Random random(5);
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string text = good.substr(0, round % 2 ? good.size() : random.below(static_cast<uint32_t>(good.size())));
    for (int k = 0; k < 4 && round % 4 != 0 && !text.empty(); ++k) {
      text[random.below(static_cast<uint32_t>(text.size()))] = static_cast<char>(random.below(256));
    }
    std::ofstream(path, std::ios::binary) << text;
    try {
      const SkeletonSpec skeleton = read_skeleton(path);
      EXPECT_GE(skeleton.joints.size(), 2u);
    } catch (const UserError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_THROW(read_skeleton(dir / "none.bvh"), UserError);
}

}  // namespace
}  // namespace nt
