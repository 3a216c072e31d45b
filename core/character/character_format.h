// SPDX-License-Identifier: Apache-2.0
// The byte layout of a character file, version 3 (docs/FORMATS.md, "Character file"). Little-endian.
//
// Every section starts on a 64-byte line of the file, so a file mapped at a 64-byte line is used in place.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/deform/lattice_view.h"

namespace nt {

static_assert(std::endian::native == std::endian::little, "character files are used in place");

inline constexpr char kCharacterMagic[8] = {'N', 'T', 'C', 'H', 'A', 'R', '\0', '\1'};
inline constexpr uint32_t kCharacterVersion = 3;
inline constexpr uint32_t kOldestCharacterVersion = 2;  // the same without a lattice
inline constexpr uint32_t kMaxTextureSide = 8192;       // what every GLES 3 device of ours takes
inline constexpr float kMaxCoordinate = 1e6f;           // character units; keeps squares in float

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
  uint32_t reserved_word;       // 0
  uint64_t lattice_offset;      // LatticeHeader; 0 where there is no lattice
  uint8_t reserved[32];         // 0
};
static_assert(sizeof(CharacterHeader) == 192 && offsetof(CharacterHeader, file_bytes) == 24);
static_assert(offsetof(CharacterHeader, lattice_offset) == 152);

// The lattice of a character and where its arrays lie, offsets from the start of the file. Every array is the one of the same
// name in core/deform/lattice_view.h and embed.h.
struct LatticeHeader {
  uint32_t form;   // LatticeForm: 0 arap, 1 stacked
  uint32_t drive;  // LatticeDrive: 0 markers, 1 landmarks
  uint32_t vertex_count, tetrahedron_count, neighbour_count, row_count;
  uint32_t marker_count, joint_count, chain_count, block_count;
  uint32_t name_bytes;
  uint32_t reserved;                 // 0
  uint64_t vertices_offset;          // Vec3[vertex_count], character units
  uint64_t tetrahedra_offset;        // uint16[4 * tetrahedron_count]
  uint64_t neighbour_start_offset;   // uint32[vertex_count + 1]
  uint64_t neighbours_offset;        // uint16[neighbour_count]
  uint64_t weights_offset;           // float[neighbour_count]
  uint64_t column_start_offset;      // uint32[vertex_count + 1]
  uint64_t rows_offset;              // uint16[row_count]
  uint64_t markers_offset;           // MarkerBinding[marker_count]
  uint64_t joint_vertex_offset;      // uint16[joint_count]
  uint64_t joint_parent_offset;      // uint16[joint_count]
  uint64_t chain_start_offset;       // uint32[joint_count + 1]
  uint64_t chain_offset;             // uint16[chain_count]
  uint64_t limits_offset;            // JointLimits[joint_count]
  uint64_t coordinates_offset;       // float[12 * block_count]
  uint64_t block_tetrahedra_offset;  // uint16[block_count]
  uint64_t slots_offset;             // uint32[CharacterHeader::vertex_count]
  uint64_t names_offset;             // char[name_bytes]
};
static_assert(sizeof(LatticeHeader) == 184 && sizeof(MarkerBinding) == 24 && sizeof(JointLimits) == 24);

inline constexpr std::size_t kChecksumFrom = offsetof(CharacterHeader, file_bytes);

// Points of the control section.
constexpr std::size_t control_section_points(uint32_t u_num, uint32_t l_num) { return 15u + u_num + l_num; }

}  // namespace nt
