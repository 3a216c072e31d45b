// SPDX-License-Identifier: Apache-2.0
#include "core/character/character.h"

#include <cstring>

#include "core/base/arena.h"
#include "core/base/hash.h"
#include "core/character/character_format.h"
#include "core/character/lattice_section.h"
#include "core/outline/fourier.h"

namespace nt {
namespace {

Status bad(const char* message) { return {StatusCode::bad_data, message}; }

// NaN fails every comparison.
bool in_range(float v, float limit) { return v >= -limit && v <= limit; }

bool all_in_range(std::span<const Vec2> points) {
  for (const Vec2 p : points) {
    if (!in_range(p.x, kMaxCoordinate) || !in_range(p.y, kMaxCoordinate)) return false;
  }
  return true;
}

bool all_in_range(std::span<const float> values) {
  for (const float v : values) {
    if (!in_range(v, kMaxCoordinate)) return false;
  }
  return true;
}

bool all_normals(std::span<const Vec3> normals) {
  constexpr float kOne = 1.001f;  // rounding
  for (const Vec3 n : normals) {
    if (!in_range(n.x, kOne) || !in_range(n.y, kOne) || !in_range(n.z, kOne)) return false;
  }
  return true;
}

bool unit(float v) { return v >= 0.0f && v <= 1.0f; }

bool all_unit(std::span<const Vec2> points) {
  for (const Vec2 p : points) {
    if (!unit(p.x) || !unit(p.y)) return false;
  }
  return true;
}

bool all_unit(std::span<const float> values) {
  for (const float v : values) {
    if (!unit(v)) return false;
  }
  return true;
}

bool all_below(std::span<const uint32_t> indices, uint32_t limit) {
  for (const uint32_t i : indices) {
    if (i >= limit) return false;
  }
  return true;
}

Status check_preamble(std::span<const std::byte> bytes, CharacterHeader& h) {
  if (bytes.size() < sizeof(CharacterHeader))
    return bad("not a character file: too short; make it again with `neontetra character`");
  if (reinterpret_cast<uintptr_t>(bytes.data()) % kAlignment != 0) {
    return {StatusCode::bad_argument, "character bytes must start on a 64-byte line"};
  }
  std::memcpy(&h, bytes.data(), sizeof h);
  if (std::memcmp(h.magic, kCharacterMagic, sizeof h.magic) != 0) {
    return bad("not a character file; make one with `neontetra character`");
  }
  if (h.version > kCharacterVersion) {
    return {StatusCode::unsupported, "character file is newer than this program; update neontetra"};
  }
  if (h.version < kOldestCharacterVersion && h.version > 0) {
    return {StatusCode::unsupported, "character file is of an older version; make it again with `neontetra character`"};
  }
  if (h.version < kOldestCharacterVersion || h.header_bytes != sizeof(CharacterHeader)) {
    return bad("character file is damaged (header); make it again with `neontetra character`");
  }
  if (h.file_bytes != bytes.size()) {
    return bad("character file is cut short or has bytes added; make it again with `neontetra character`");
  }
  if (h.checksum != hash_bytes(bytes.data() + kChecksumFrom, bytes.size() - kChecksumFrom)) {
    return bad("character file is damaged (checksum); make it again with `neontetra character`");
  }
  return {};
}

Status check_counts(const CharacterHeader& h, const Limits& limits) {
  const bool axis = h.u_num >= 1 && h.u_num <= kMaxUpAxis && h.l_num >= 1 && h.l_num <= kMaxLowAxis;
  const bool harmonics = h.harmonics >= 1 && h.harmonics <= kMaxHarmonics;
  const bool flags = (h.flags & ~kCharacterFlags) == 0;
  const bool texture = h.texture_width >= 1 && h.texture_width <= kMaxTextureSide && h.texture_height >= 1 &&
                       h.texture_height <= kMaxTextureSide;
  if (!axis || !harmonics || !flags || !texture || h.vertex_count < 3 || h.triangle_count < 1) {
    return bad("character file is damaged (counts); make it again with `neontetra character`");
  }
  if (h.vertex_count > static_cast<uint32_t>(limits.max_vertices)) {
    return {StatusCode::unsupported, "character has too many vertices; raise max_vertices or make it with fewer"};
  }
  if (h.triangle_count > static_cast<uint32_t>(limits.max_triangles)) {
    return {StatusCode::unsupported, "character has too many triangles; raise max_triangles or make it with fewer"};
  }
  if (control_section_points(h.u_num, h.l_num) > static_cast<std::size_t>(limits.max_control_points)) {
    return {StatusCode::unsupported, "character has too many control points; raise max_control_points"};
  }
  return {};
}

bool read_figure(const CharacterHeader& h, Character& c) {
  c.figure = {
      {h.figure_centre[0], h.figure_centre[1]}, {h.figure_dir[0], h.figure_dir[1]}, (h.flags & kCharacterMirror) != 0};
  constexpr float kUnit = 1e-3f;  // rounding
  const Vec2 range[] = {c.figure.centre, c.figure.dir};
  if (!all_in_range(range) || !in_range(length_sq(c.figure.dir) - 1.0f, kUnit)) return false;
  if (h.deformer > static_cast<uint32_t>(MlsKind::affine)) return false;
  c.deformer = static_cast<MlsKind>(h.deformer);
  return true;
}

ControlPoints read_controls(std::span<const Vec2> at, int u_num, int l_num, uint32_t flags) {
  ControlPoints c;
  std::size_t i = 0;
  c.centre = at[i++], c.head = at[i++], c.tail = at[i++];
  for (int k = 0; k < u_num; ++k) c.up_axis[k] = at[i++];
  for (int k = 0; k < l_num; ++k) c.low_axis[k] = at[i++];
  for (int k = 0; k < kMaxFins; ++k) {
    FinPoints& fin = c.fins[k];
    fin.present = (flags >> k & 1u) != 0;
    fin.top = at[i++], fin.bottom = at[i++], fin.tip = at[i++];
  }
  return c;
}

// Flat characters have neither section, solid ones both.
Status read_solid(std::span<const std::byte> bytes, const CharacterHeader& h, Character& c) {
  if ((h.flags & kCharacterSolid) == 0) {
    if (h.heights_offset == 0 && h.normals_offset == 0) return {};
    return bad("character file is damaged (offsets); make it again with `neontetra character`");
  }
  c.heights = section<float>(bytes, h.heights_offset, h.vertex_count);
  c.normals = section<Vec3>(bytes, h.normals_offset, h.vertex_count);
  if (c.heights.empty() || c.normals.empty()) {
    return bad("character file is damaged (offsets); make it again with `neontetra character`");
  }
  if (!all_in_range(c.heights) || !all_normals(c.normals)) {
    return bad("character file is damaged (values out of range); make it again with `neontetra character`");
  }
  return {};
}

}  // namespace

Result<Character> open_character(std::span<const std::byte> bytes, const Limits& limits) {
  CharacterHeader h;
  if (const Status s = check_preamble(bytes, h); !s.ok()) return s;
  if (const Status s = check_counts(h, limits); !s.ok()) return s;
  const std::size_t control_points = control_section_points(h.u_num, h.l_num);
  const auto controls = section<Vec2>(bytes, h.controls_offset, control_points);
  Character c;
  c.confidences = section<float>(bytes, h.confidences_offset, control_points);
  c.vertices = section<Vec2>(bytes, h.vertices_offset, h.vertex_count);
  c.texcoords = section<Vec2>(bytes, h.texcoords_offset, h.vertex_count);
  c.triangles = section<uint32_t>(bytes, h.triangles_offset, uint64_t{3} * h.triangle_count);
  const auto texture = section<uint8_t>(bytes, h.texture_offset, uint64_t{4} * h.texture_width * h.texture_height);
  if (controls.empty() || c.confidences.empty() || c.vertices.empty() || c.texcoords.empty() || c.triangles.empty() ||
      texture.empty()) {
    return bad("character file is damaged (offsets); make it again with `neontetra character`");
  }
  if (!all_in_range(controls) || !all_unit(c.confidences) || !all_in_range(c.vertices) || !all_unit(c.texcoords) ||
      !all_below(c.triangles, h.vertex_count) || !read_figure(h, c)) {
    return bad("character file is damaged (values out of range); make it again with `neontetra character`");
  }
  if (const Status s = read_solid(bytes, h, c); !s.ok()) return s;
  if (const Status s = read_lattice(bytes, h, limits, c); !s.ok()) return s;
  c.u_num = static_cast<int>(h.u_num);
  c.l_num = static_cast<int>(h.l_num);
  c.harmonics = static_cast<int>(h.harmonics);
  c.has_tail_fin = (h.flags & kCharacterTailFin) != 0;
  c.rest = read_controls(controls, c.u_num, c.l_num, h.flags);
  c.texture.pixels = texture.data();
  c.texture.width = static_cast<int>(h.texture_width);
  c.texture.height = static_cast<int>(h.texture_height);
  c.texture.stride = 4 * c.texture.width;
  c.texture.format = PixelFormat::rgba8;
  c.texture.revision = h.checksum;  // another character in the same slot is uploaded again
  return c;
}

}  // namespace nt
