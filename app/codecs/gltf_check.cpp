// SPDX-License-Identifier: Apache-2.0
#include "app/codecs/gltf_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "platform/camera.h"

namespace nt {
namespace {

uint32_t word_at(const std::string& bytes, std::size_t at) {
  uint32_t v = 0;
  std::memcpy(&v, bytes.data() + at, sizeof v);
  return v;
}

// The JSON of a GLB: the first of its chunks, all of which must end within the file. In version 1 it is the only one.
std::string json_of_glb(const std::string& path, const std::string& bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const UserError cut(path + ": it is cut short or damaged: a part of it is longer than the file");
  if (bytes.size() < kHeader + kChunkHeader || word_at(bytes, 8) > bytes.size()) throw cut;
  const bool has_chunks = word_at(bytes, 4) > 1;
  for (std::size_t at = kHeader; at + kChunkHeader <= bytes.size(); at += kChunkHeader + word_at(bytes, at)) {
    if (word_at(bytes, at) > bytes.size() - at - kChunkHeader) throw cut;
    if (!has_chunks) break;
  }
  return bytes.substr(kHeader + kChunkHeader, word_at(bytes, kHeader));
}

// Null where it is damaged, or so deep that a reader that calls itself for each level would run out of stack.
nlohmann::json parse(const std::string& text) {
  constexpr int kDeepest = 256;
  bool deep = false;
  const auto look = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    deep = deep || depth > kDeepest;
    return !deep;
  };
  nlohmann::json json = nlohmann::json::parse(text, look, false);
  return deep || json.is_discarded() ? nlohmann::json() : json;
}

// An index of an accessor of so many 4x4 matrices of floats, at least.
bool has_matrices(const nlohmann::json& json, const nlohmann::json& index, std::size_t count) {
  constexpr int kFloat = 5126;
  const auto accessors = json.find("accessors");
  if (!index.is_number_unsigned() || accessors == json.end() || !accessors->is_array()) return false;
  const auto at = index.get<std::size_t>();
  if (at >= accessors->size() || !(*accessors)[at].is_object()) return false;
  const nlohmann::json& a = (*accessors)[at];
  const auto is = [&](const char* key, const nlohmann::json& value) { return a.contains(key) && a[key] == value; };
  return is("type", "MAT4") && is("componentType", kFloat) && a.contains("count") && a["count"].is_number_unsigned() &&
         a["count"].get<std::size_t>() >= count;
}

void check_skins(const std::string& path, const nlohmann::json& json) {
  const auto skins = json.find("skins");
  if (skins == json.end()) return;
  for (const auto& skin : *skins) {
    if (!skin.is_object() || !skin.contains("joints") || !skin.contains("inverseBindMatrices") ||
        !has_matrices(json, skin["inverseBindMatrices"], skin["joints"].size())) {
      throw UserError(path +
                      ": its skin does not say how its joints stand (inverseBindMatrices); export it again with them");
    }
  }
}

}  // namespace

void check_gltf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".glb" && ending != ".gltf" && ending != ".vrm") return;
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.compare(0, 4, "glTF") == 0) bytes = json_of_glb(path, bytes);
  const nlohmann::json json = parse(bytes);
  if (!json.is_object()) throw UserError(path + " is no glTF that can be read: it is damaged or of another kind");
  const bool first_version =
      json.contains("skins") && json["skins"].is_object();  // named, and never read as a skeleton
  if (!first_version) check_skins(path, json);
}

}  // namespace nt
