// SPDX-License-Identifier: Apache-2.0
// The byte layout of a character file, version 2 (docs/FORMATS.md, "Character file"). Little-endian.
//
// Every section starts on a 64-byte line of the file, so a file mapped at a 64-byte line is used in place.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace nt {

static_assert(std::endian::native == std::endian::little, "character files are used in place");

inline constexpr char kCharacterMagic[8] = {'N', 'T', 'C', 'H', 'A', 'R', '\0', '\1'};
inline constexpr uint32_t kCharacterVersion = 2;
inline constexpr uint32_t kMaxTextureSide = 8192;  // what every GLES 3 device of ours takes
inline constexpr float kMaxCoordinate = 1e6f;      // character units; keeps squares in float

// Bits of `flags`: bit i says that fin i is there (core/character/character.h, FinIndex), the others follow.
inline constexpr uint32_t kCharacterFinBits = 0xf;
inline constexpr uint32_t kCharacterTailFin = 0x10;  // the tail ends in a fin
inline constexpr uint32_t kCharacterSolid = 0x20;    // heights and normals are there: a 3D character
inline constexpr uint32_t kCharacterMirror = 0x40;   // FigureFrame::mirror
inline constexpr uint32_t kCharacterFlags = kCharacterFinBits | kCharacterTailFin | kCharacterSolid | kCharacterMirror;

struct CharacterHeader {
  char magic[8];
  uint32_t version;
  uint32_t header_bytes;  // 192
  uint64_t checksum;      // FNV-1a (core/base/hash.h) of all bytes from file_bytes on
  uint64_t file_bytes;
  uint32_t u_num, l_num;
  uint32_t harmonics;  // S, [F] Eq 2
  uint32_t flags;
  uint32_t vertex_count, triangle_count;
  uint32_t texture_width, texture_height;
  uint64_t controls_offset;     // Vec2: centre, head, tail, up_axis[u_num], low_axis[l_num], then per fin top junction,
                                // bottom junction, tip; points of a fin that is not there are 0
  uint64_t confidences_offset;  // float, one per control point, 0 to 1
  uint64_t vertices_offset;     // Vec2[vertex_count], character units
  uint64_t heights_offset;      // float[vertex_count], character units; 0 for a flat character
  uint64_t normals_offset;      // Vec3[vertex_count], at most unit length; 0 for a flat character
  uint64_t texcoords_offset;    // Vec2[vertex_count]
  uint64_t triangles_offset;    // uint32[3 * triangle_count]
  uint64_t texture_offset;      // rgba8, rows top down without padding
  float figure_centre[2];       // FigureFrame, figure pixels
  float figure_dir[2];          // unit length
  uint32_t deformer;            // MlsKind: 0 rigid, 1 similarity, 2 affine
  uint8_t reserved[44];         // 0
};
static_assert(sizeof(CharacterHeader) == 192 && offsetof(CharacterHeader, file_bytes) == 24);

inline constexpr std::size_t kChecksumFrom = offsetof(CharacterHeader, file_bytes);

// Points of the control section.
constexpr std::size_t control_section_points(uint32_t u_num, uint32_t l_num) { return 15u + u_num + l_num; }

}  // namespace nt
