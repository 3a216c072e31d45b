// SPDX-License-Identifier: Apache-2.0
// A small character made of a grid of triangles, as the bytes of a character file, without the app: a straight body of 150
// units with a fin at either side; on demand a solid, all at one height. For tests of core.
#pragma once
#include <cstddef>
#include <cstring>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/arena.h"
#include "core/base/hash.h"
#include "core/character/character.h"
#include "core/character/character_format.h"

namespace nt::test {

class DrawnCharacter {
 public:
  explicit DrawnCharacter(bool fins = true, int u_num = 3, int l_num = 15, bool solid = false) {
    CharacterHeader h{};
    std::memcpy(h.magic, kCharacterMagic, sizeof h.magic);
    h.version = kCharacterVersion, h.header_bytes = sizeof h;
    h.figure_centre[0] = 100, h.figure_centre[1] = 100, h.figure_dir[1] = -1;
    h.u_num = static_cast<uint32_t>(u_num), h.l_num = static_cast<uint32_t>(l_num);
    h.harmonics = 5, h.flags = kCharacterTailFin | (fins ? 3u : 0u) | (solid ? kCharacterSolid : 0u);
    std::vector<std::byte> out(sizeof h);
    const std::vector<Vec2> controls = control_points(fins, u_num, l_num);
    const std::vector<float> confidences(controls.size(), 0.75f);
    std::vector<Vec2> vertices, texcoords;
    std::vector<uint32_t> triangles;
    grid(fins, vertices, triangles);
    for (const Vec2 v : vertices) texcoords.push_back({0.5f + v.x / 200, 0.5f - v.y / 200});
    const std::vector<uint8_t> texture(4 * 4 * 2, 255);
    h.vertex_count = static_cast<uint32_t>(vertices.size());
    h.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
    h.texture_width = 4, h.texture_height = 2;
    h.controls_offset = append(out, std::as_bytes(std::span(controls)));
    h.confidences_offset = append(out, std::as_bytes(std::span(confidences)));
    h.vertices_offset = append(out, std::as_bytes(std::span(vertices)));
    if (solid) {
      const std::vector<float> heights(vertices.size(), 5.0f);
      const std::vector<Vec3> normals(vertices.size(), Vec3{0, 0, 1});
      h.heights_offset = append(out, std::as_bytes(std::span(heights)));
      h.normals_offset = append(out, std::as_bytes(std::span(normals)));
    }
    h.texcoords_offset = append(out, std::as_bytes(std::span(texcoords)));
    h.triangles_offset = append(out, std::as_bytes(std::span(triangles)));
    h.texture_offset = append(out, std::as_bytes(std::span(texture)));
    h.file_bytes = out.size();
    std::memcpy(out.data(), &h, sizeof h);
    h.checksum = hash_bytes(out.data() + kChecksumFrom, out.size() - kChecksumFrom);
    std::memcpy(out.data(), &h, sizeof h);
    size_ = out.size();
    lines_.resize((size_ + kAlignment - 1) / kAlignment);
    std::memcpy(lines_.data(), out.data(), size_);
  }
  std::span<std::byte> bytes() { return {reinterpret_cast<std::byte*>(lines_.data()), size_}; }
  CharacterHeader header() {
    CharacterHeader h;
    std::memcpy(&h, lines_.data(), sizeof h);
    return h;
  }

 private:
  struct alignas(kAlignment) Line {
    std::byte bytes[kAlignment];
  };
  static constexpr float kCell = 4, kHead = 56, kTail = -94, kHalfWidth = 14;

  static uint64_t append(std::vector<std::byte>& out, std::span<const std::byte> data) {
    const std::size_t offset = align_up(out.size());
    out.resize(offset);
    out.insert(out.end(), data.begin(), data.end());
    return offset;
  }
  static std::vector<Vec2> control_points(bool fins, int u_num, int l_num) {
    std::vector<Vec2> c{{0, 0}, {0, kHead}, {0, kTail}};
    for (int i = 1; i <= u_num; ++i) c.push_back({0, kHead * static_cast<float>(i) / static_cast<float>(u_num + 1)});
    for (int i = 1; i <= l_num; ++i) c.push_back({0, kTail * static_cast<float>(i) / static_cast<float>(l_num + 1)});
    const Vec2 top{kHalfWidth, 26}, bottom{kHalfWidth, 6}, tip{50, -4};
    const auto left = [](Vec2 p) { return Vec2{-p.x, p.y}; };
    const std::vector<Vec2> f{left(top), left(bottom), left(tip), top, bottom, tip};
    for (const Vec2 p : f) c.push_back(fins ? p : Vec2{});
    c.resize(c.size() + 6);  // no second pair
    return c;
  }
  static bool inside(bool fins, Vec2 p) {
    const float x = p.x < 0 ? -p.x : p.x;
    if (x < kHalfWidth && p.y > kTail && p.y < kHead) return true;
    if (!fins || x < kHalfWidth || x > 50) return false;
    const float t = (x - kHalfWidth) / 36;  // from root to tip: a leaf 20 units wide at the root
    const float middle = 16 - 20 * t, half = 10 - 5 * t;
    return p.y > middle - half && p.y < middle + half;
  }
  static void grid(bool fins, std::vector<Vec2>& vertices, std::vector<uint32_t>& triangles) {
    std::map<std::pair<int, int>, uint32_t> known;
    const auto vertex = [&](int i, int j) {
      const auto [it, added] = known.try_emplace({i, j}, static_cast<uint32_t>(vertices.size()));
      if (added) vertices.push_back({kCell * static_cast<float>(i), kCell * static_cast<float>(j)});
      return it->second;
    };
    for (int j = -24; j < 15; ++j) {
      for (int i = -14; i < 14; ++i) {
        if (!inside(fins, {kCell * (static_cast<float>(i) + 0.5f), kCell * (static_cast<float>(j) + 0.5f)})) continue;
        const uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
        triangles.insert(triangles.end(), {a, b, c, a, c, d});
      }
    }
  }

  std::vector<Line> lines_;
  std::size_t size_ = 0;
};

}  // namespace nt::test
