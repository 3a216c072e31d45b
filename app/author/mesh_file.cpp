// SPDX-License-Identifier: Apache-2.0
#include "app/author/mesh_file.h"

#include <assimp/GltfMaterial.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "app/author/mesh_soup.h"
#include "app/codecs/gltf_check.h"
#include "platform/camera.h"
#include "platform/sim/quiet_stderr.h"

namespace nt {
namespace {

constexpr uintmax_t kMostBytes = 256u << 20;
constexpr std::size_t kMostTriangles = 4'000'000;

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

std::string one_line(std::string s) {
  std::replace_if(
      s.begin(), s.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  return s.size() > 160 ? s.substr(0, 160) + "..." : s;
}

// Rigs and tool geometry that modelling programs keep beside the figure.
bool is_helper(const std::string& name) {
  const std::string n = lower(name);
  return n.rfind("helper", 0) == 0 || n.rfind("joint", 0) == 0;
}

uint32_t packed(const aiColor4D& c) {
  const auto byte = [](float v) { return static_cast<uint32_t>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
  return byte(c.r) | byte(c.g) << 8 | byte(c.b) << 16 | 0xff000000u;
}

cv::Mat to_rgba(const cv::Mat& image) {
  cv::Mat eight = image, rgba;
  if (image.depth() != CV_8U) image.convertTo(eight, CV_8U, image.depth() == CV_16U ? 1.0 / 257 : 255.0);
  if (eight.channels() == 1) cv::cvtColor(eight, rgba, cv::COLOR_GRAY2RGBA);
  if (eight.channels() == 3) cv::cvtColor(eight, rgba, cv::COLOR_BGR2RGBA);
  if (eight.channels() == 4) cv::cvtColor(eight, rgba, cv::COLOR_BGRA2RGBA);
  return rgba;
}

class Reader {
 public:
  Reader(const std::string& path, const ToldAxes& told) : path_(path), told_(told) {}
  SourceMesh read();

 private:
  const aiScene* import();
  cv::Mat texture_of(const aiMaterial& material);
  void add_material(const aiMaterial& material);
  void walk(const aiNode& node, const aiMatrix4x4& parent);
  void add_part(const aiMesh& mesh, const aiMatrix4x4& place);
  void add_triangle(const aiMesh& mesh, const aiFace& face, const aiMatrix4x4& place);
  void weld();

  std::string path_;
  ToldAxes told_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  MeshSoup soup_;
  SourceMesh out_;
  int helpers_ = 0, dropped_ = 0;
  std::size_t seen_ = 0;
};

// A PLY header that promises more elements than the file has bytes: Assimp would set aside room for them all.
void check_ply(const std::string& path, uintmax_t size) {
  std::ifstream in(path, std::ios::binary);
  std::string word;
  for (int words = 0; words < 400 && in >> word && word != "end_header"; ++words) {
    if (word != "element") continue;
    double count = 0;
    if (in >> word >> count && count > static_cast<double>(size)) {
      throw UserError(path + ": its header promises more than the file holds; it is cut short or damaged");
    }
  }
}

const aiScene* Reader::import() {
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(path_, error);
  if (error) throw UserError("cannot read the mesh " + path_ + ": no such file, or no right to read it");
  if (size > kMostBytes) throw UserError(path_ + ": more than 256 MB; reduce the mesh first");
  if (lower(path_).ends_with(".ply")) check_ply(path_, size);
  check_gltf(path_);
  importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = nullptr;
  try {
    scene = importer_.ReadFile(path_, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FlipUVs);
  } catch (const std::exception&) {
    scene = nullptr;
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string why = one_line(importer_.GetErrorString());
    throw UserError(path_ + " is not a mesh that can be read" + (why.empty() ? "" : " (" + why + ")") +
                    "; use GLB, glTF, OBJ or PLY");
  }
  if (scene->mNumMeshes == 0) throw UserError(path_ + ": there are no triangles in this mesh");
  return scene;
}

cv::Mat Reader::texture_of(const aiMaterial& material) {
  aiString name;
  if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS &&
      material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS) {
    return {};
  }
  cv::Mat image;
  const QuietStderr quiet;
  try {
    if (const aiTexture* inside = scene_->GetEmbeddedTexture(name.C_Str())) {
      if (inside->mHeight == 0) {
        const cv::Mat bytes(1, static_cast<int>(inside->mWidth), CV_8U, inside->pcData);
        image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
      } else {
        image = cv::Mat(static_cast<int>(inside->mHeight), static_cast<int>(inside->mWidth), CV_8UC4, inside->pcData)
                    .clone();
      }
    } else {
      std::string file = name.C_Str();
      std::replace(file.begin(), file.end(), '\\', '/');
      const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
      std::filesystem::path at = folder / file;
      // Exporters write the artist's own folders: the file beside the mesh is meant.
      if (!std::filesystem::exists(at)) at = folder / std::filesystem::path(file).filename();
      image = cv::imread(at.string(), cv::IMREAD_UNCHANGED);
    }
  } catch (const std::exception&) {
    image.release();
  }
  if (image.empty()) {
    out_.notes.push_back("texture " + one_line(name.C_Str()) + " cannot be read: its material's colour is used");
    return {};
  }
  return to_rgba(image);
}

void Reader::add_material(const aiMaterial& material) {
  SoupMaterial m;
  aiColor4D colour;
  if (material.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
    m.colour = packed(colour);
  }
  m.texture = texture_of(material);
  if (!m.texture.empty()) {
    aiString mode;
    const bool clear =
        material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS && std::strcmp(mode.C_Str(), "OPAQUE") != 0;
    if (!clear) cv::insertChannel(cv::Mat(m.texture.size(), CV_8U, cv::Scalar(255)), m.texture, 3);
  }
  soup_.materials.push_back(m);
}

void Reader::add_triangle(const aiMesh& mesh, const aiFace& face, const aiMatrix4x4& place) {
  ++seen_;
  SoupCorner c[3];
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned i = face.mIndices[k];
    if (i >= mesh.mNumVertices) return;
    const aiVector3D p = place * mesh.mVertices[i];
    if (!(std::abs(p.x) < 1e12f && std::abs(p.y) < 1e12f && std::abs(p.z) < 1e12f)) return;
    c[k].position = {p.x, p.y, p.z};
    if (mesh.mTextureCoords[0] != nullptr) {
      const aiVector3D uv = mesh.mTextureCoords[0][i];
      c[k].texcoord = {std::abs(uv.x) < 1e6f ? uv.x : 0.0f, std::abs(uv.y) < 1e6f ? uv.y : 0.0f};
    }
    if (mesh.mColors[0] != nullptr) c[k].colour = packed(mesh.mColors[0][i]), soup_.has_colours = true;
  }
  soup_.corners.insert(soup_.corners.end(), c, c + 3);
  soup_.material_of.push_back(
      std::min<uint32_t>(mesh.mMaterialIndex, static_cast<uint32_t>(soup_.materials.size() - 1)));
}

void Reader::add_part(const aiMesh& mesh, const aiMatrix4x4& place) {
  if (is_helper(mesh.mName.C_Str())) {
    ++helpers_;
    return;
  }
  ++out_.parts;
  if (soup_.corners.size() / 3 + mesh.mNumFaces > kMostTriangles) {
    throw UserError(path_ + ": more than 4 million triangles; reduce the mesh first");
  }
  const bool mirrored = place.Determinant() < 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    if (mirrored) std::swap(face.mIndices[1], face.mIndices[2]);
    add_triangle(mesh, face, place);
    if (mirrored) std::swap(face.mIndices[1], face.mIndices[2]);
  }
}

void Reader::walk(const aiNode& node, const aiMatrix4x4& parent) {
  const aiMatrix4x4 place = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene_->mNumMeshes) continue;
    if (is_helper(node.mName.C_Str())) ++helpers_;
    else add_part(*scene_->mMeshes[node.mMeshes[i]], place);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], place);
}

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// Corners at one place with the same texture coordinates become one vertex; triangles that shrink to a line, or that are
// there already, go.
void Reader::weld() {
  std::map<std::array<float, 5>, uint32_t> known;
  std::set<std::array<uint32_t, 3>> triangles;
  for (std::size_t t = 0; t < soup_.material_of.size(); ++t) {
    const SoupCorner* c = &soup_.corners[3 * t];
    if (same(c[0].position, c[1].position) || same(c[1].position, c[2].position) || same(c[2].position, c[0].position))
      continue;
    std::array<uint32_t, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = c[k].position;
      const Vec2 uv = c[k].texcoord;
      const auto [it, added] = known.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f, uv.x, uv.y},
                                                 static_cast<uint32_t>(out_.positions.size()));
      if (added) out_.positions.push_back(p), out_.texcoords.push_back(uv);
      corner[k] = it->second;
    }
    std::array<uint32_t, 3> sorted = corner;
    std::sort(sorted.begin(), sorted.end());
    if (!triangles.insert(sorted).second) continue;
    out_.triangles.insert(out_.triangles.end(), corner.begin(), corner.end());
  }
}

SourceMesh Reader::read() {
  scene_ = import();
  for (unsigned i = 0; i < scene_->mNumMaterials; ++i) add_material(*scene_->mMaterials[i]);
  if (soup_.materials.empty()) soup_.materials.emplace_back();
  walk(*scene_->mRootNode, aiMatrix4x4());
  if (helpers_ > 0) out_.notes.push_back(std::to_string(helpers_) + " helper parts (helper*, joint*) were left out");
  if (soup_.material_of.empty()) throw UserError(path_ + ": there are no triangles in this mesh");
  out_.axes = find_axes(soup_.corners, told_);
  turn_to(soup_.corners, out_.axes);
  const bool textured = std::any_of(soup_.materials.begin(), soup_.materials.end(),
                                    [](const SoupMaterial& m) { return !m.texture.empty(); });
  if (soup_.has_colours && !textured) {
    out_.texture = bake_colours(soup_);
  } else {
    int cut = 0;
    out_.texture = bake_atlas(soup_, cut);
    if (cut > 0)
      out_.notes.push_back("the texture repeats within " + std::to_string(cut) + " triangles: it is cut there");
  }
  weld();
  const std::size_t kept = out_.triangles.size() / 3;
  if (kept == 0) throw UserError(path_ + ": no triangle of this mesh has an area");
  if (kept < seen_)
    out_.notes.push_back(std::to_string(seen_ - kept) + " triangles without area, doubled or broken were dropped");
  return out_;
}

}  // namespace

SourceMesh read_mesh_file(const std::string& path, const ToldAxes& told) { return Reader(path, told).read(); }

}  // namespace nt
