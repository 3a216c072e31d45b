// SPDX-License-Identifier: Apache-2.0
#include "tests/support/drawn_fish.h"

#include <cstring>
#include <vector>

#include "core/base/hash.h"
#include "core/base/vec2.h"
#include "core/character/character_format.h"

namespace nt::test {
namespace {

constexpr uint32_t kUp = 3, kLow = 15;
constexpr uint64_t kControlsAt = align_up(sizeof(CharacterHeader));
constexpr uint64_t kConfidencesAt = align_up(kControlsAt + kFishControls * sizeof(Vec2));
constexpr uint64_t kVerticesAt = align_up(kConfidencesAt + kFishControls * sizeof(float));
constexpr uint64_t kTexcoordsAt = align_up(kVerticesAt + kFishVertices * sizeof(Vec2));
constexpr uint64_t kTrianglesAt = align_up(kTexcoordsAt + kFishVertices * sizeof(Vec2));
constexpr uint64_t kTextureAt = align_up(kTrianglesAt + 3 * kFishTriangles * sizeof(uint32_t));
constexpr uint64_t kFileBytes = kTextureAt + 4;
static_assert(control_section_points(kUp, kLow) == kFishControls);

// The body lies from y = 80 (head) to y = -120 (tail), fins at its sides.
std::vector<Vec2> control_points() {
  std::vector<Vec2> points{{0, 0}, {0, 80}, {0, -120}};
  for (uint32_t i = 1; i <= kUp; ++i) points.push_back({0, 20.0f * static_cast<float>(i)});
  for (uint32_t i = 1; i <= kLow; ++i) points.push_back({0, -7.5f * static_cast<float>(i)});
  for (const Vec2 p : {Vec2{-18, 40}, Vec2{-18, 25}, Vec2{-45, 15}}) points.push_back(p);
  for (const Vec2 p : {Vec2{18, 40}, Vec2{18, 25}, Vec2{45, 15}}) points.push_back(p);
  points.resize(points.size() + 6);  // no second pair
  return points;
}

std::vector<uint32_t> triangles() {
  std::vector<uint32_t> out;
  for (uint32_t r = 0; r + 1 < kFishRows; ++r) {
    for (uint32_t c = 0; c + 1 < kFishColumns; ++c) {
      const uint32_t i = r * kFishColumns + c;
      for (const uint32_t k : {i, i + 1, i + kFishColumns, i + 1, i + kFishColumns + 1, i + kFishColumns})
        out.push_back(k);
    }
  }
  return out;
}

template <class T>
void put(std::span<std::byte> bytes, uint64_t at, const std::vector<T>& values) {
  std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

}  // namespace

DrawnFish::DrawnFish() : block_(kFileBytes) {
  const std::span<std::byte> bytes = block_.span();
  std::memset(bytes.data(), 0, bytes.size());
  std::vector<Vec2> vertices, texcoords;
  for (int r = 0; r < kFishRows; ++r) {
    for (int c = 0; c < kFishColumns; ++c) {
      const Vec2 unit{static_cast<float>(c) / (kFishColumns - 1), static_cast<float>(r) / (kFishRows - 1)};
      vertices.push_back({100.0f * unit.x - 50.0f, 80.0f - 200.0f * unit.y});
      texcoords.push_back(unit);
    }
  }
  put(bytes, kControlsAt, control_points());
  put(bytes, kConfidencesAt, std::vector<float>(kFishControls, 1.0f));
  put(bytes, kVerticesAt, vertices);
  put(bytes, kTexcoordsAt, texcoords);
  put(bytes, kTrianglesAt, triangles());
  put(bytes, kTextureAt, std::vector<uint8_t>{255, 255, 255, 255});

  CharacterHeader h{};
  std::memcpy(h.magic, kCharacterMagic, sizeof h.magic);
  h.version = kCharacterVersion;
  h.header_bytes = sizeof h;
  h.file_bytes = kFileBytes;
  h.u_num = kUp, h.l_num = kLow, h.harmonics = 5, h.flags = kCharacterTailFin | 3u;
  h.figure_dir[1] = -1;
  h.vertex_count = kFishVertices, h.triangle_count = kFishTriangles;
  h.texture_width = h.texture_height = 1;
  h.controls_offset = kControlsAt, h.confidences_offset = kConfidencesAt;
  h.vertices_offset = kVerticesAt, h.texcoords_offset = kTexcoordsAt;
  h.triangles_offset = kTrianglesAt, h.texture_offset = kTextureAt;
  std::memcpy(bytes.data(), &h, sizeof h);
  h.checksum = hash_bytes(bytes.data() + kChecksumFrom, bytes.size() - kChecksumFrom);
  std::memcpy(bytes.data(), &h, sizeof h);
}

}  // namespace nt::test
