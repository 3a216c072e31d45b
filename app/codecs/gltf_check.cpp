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

// The JSON of a GLB: the first of its chunks, all of which must end within the file.
std::string json_of_glb(const std::string& path, const std::string& bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const UserError cut(path + ": it is cut short or damaged: a part of it is longer than the file");
  if (bytes.size() < kHeader + kChunkHeader) throw cut;
  for (std::size_t at = kHeader; at < bytes.size();) {
    if (bytes.size() - at < kChunkHeader || word_at(bytes, at) > bytes.size() - at - kChunkHeader) throw cut;
    at += kChunkHeader + word_at(bytes, at);
  }
  return bytes.substr(kHeader + kChunkHeader, word_at(bytes, kHeader));
}

void check_skins(const std::string& path, const nlohmann::json& json) {
  const auto skins = json.find("skins");
  if (skins == json.end()) return;
  for (const auto& skin : *skins) {
    if (!skin.is_object() || !skin.contains("inverseBindMatrices")) {
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
  if (ending != ".glb" && ending != ".gltf") return;
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.compare(0, 4, "glTF") == 0) bytes = json_of_glb(path, bytes);
  const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
  if (!json.is_object()) throw UserError(path + " is no glTF that can be read: it is damaged or of another kind");
  check_skins(path, json);
}

}  // namespace nt
