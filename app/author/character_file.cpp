// SPDX-License-Identifier: Apache-2.0
#include "app/author/character_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/base/arena.h"
#include "core/base/hash.h"
#include "core/character/character_format.h"
#include "platform/camera.h"

namespace nt {
namespace {

std::vector<Vec2> control_section(const Character& character) {
  const ControlPoints& c = character.rest;
  std::vector<Vec2> out{c.centre, c.head, c.tail};
  out.insert(out.end(), c.up_axis, c.up_axis + character.u_num);
  out.insert(out.end(), c.low_axis, c.low_axis + character.l_num);
  for (const FinPoints& fin : c.fins) {
    for (const Vec2 p : {fin.top, fin.bottom, fin.tip}) out.push_back(fin.present ? p : Vec2{});
  }
  return out;
}

// Confidences given for each control point, or full ones.
std::vector<float> confidence_section(const Character& character, std::size_t controls) {
  std::vector<float> out(character.confidences.begin(), character.confidences.end());
  out.resize(controls, 1.0f);
  return out;
}

uint32_t flags_of(const Character& character) {
  uint32_t flags = character.has_tail_fin ? kCharacterTailFin : 0u;
  if (character.solid()) flags |= kCharacterSolid;
  if (character.figure.mirror) flags |= kCharacterMirror;
  for (int i = 0; i < kMaxFins; ++i) flags |= character.rest.fins[i].present ? 1u << i : 0u;
  return flags;
}

// Appends a section on the next 64-byte line and returns its offset.
uint64_t append(std::vector<std::byte>& bytes, const void* data, std::size_t size) {
  const std::size_t offset = align_up(bytes.size());
  bytes.resize(offset + size);
  if (size > 0) std::memcpy(bytes.data() + offset, data, size);
  return offset;
}

template <class T>
uint64_t append(std::vector<std::byte>& bytes, std::span<const T> data) {
  return append(bytes, data.data(), data.size_bytes());
}

// The lattice's arrays behind its header; returns where the header is.
uint64_t append_lattice(std::vector<std::byte>& bytes, const CharacterLattice& l) {
  const LatticeView& v = l.view;
  const SkeletonView& s = v.skeleton;
  const auto count = [](std::size_t n) { return static_cast<uint32_t>(n); };
  LatticeHeader h{};
  h.form = static_cast<uint32_t>(v.form), h.drive = static_cast<uint32_t>(l.drive);
  h.vertex_count = count(v.vertices.size()), h.tetrahedron_count = count(v.tetrahedra.size() / 4);
  h.neighbour_count = count(v.neighbours.size()), h.row_count = count(v.rows.size());
  h.marker_count = count(v.markers.size()), h.joint_count = count(s.joints()), h.chain_count = count(s.chain.size());
  h.block_count = count(l.embedding.blocks()), h.name_bytes = count(l.names.size());
  const uint64_t at = append(bytes, &h, sizeof h);
  h.vertices_offset = append(bytes, v.vertices), h.tetrahedra_offset = append(bytes, v.tetrahedra);
  h.neighbour_start_offset = append(bytes, v.neighbour_start), h.neighbours_offset = append(bytes, v.neighbours);
  h.weights_offset = append(bytes, v.weights), h.column_start_offset = append(bytes, v.column_start);
  h.rows_offset = append(bytes, v.rows), h.markers_offset = append(bytes, v.markers);
  h.joint_vertex_offset = append(bytes, s.vertex), h.joint_parent_offset = append(bytes, s.parent);
  h.chain_start_offset = append(bytes, s.chain_start), h.chain_offset = append(bytes, s.chain);
  h.limits_offset = append(bytes, s.limits), h.coordinates_offset = append(bytes, l.embedding.coordinates);
  h.block_tetrahedra_offset = append(bytes, l.embedding.tetrahedron), h.slots_offset = append(bytes, l.slots);
  h.names_offset = append(bytes, l.names);
  std::memcpy(bytes.data() + at, &h, sizeof h);
  return at;
}

}  // namespace

std::vector<std::byte> character_bytes(const Character& character) {
  CharacterHeader h{};
  std::memcpy(h.magic, kCharacterMagic, sizeof h.magic);
  h.version = kCharacterVersion;
  h.header_bytes = sizeof h;
  h.u_num = static_cast<uint32_t>(character.u_num);
  h.l_num = static_cast<uint32_t>(character.l_num);
  h.harmonics = static_cast<uint32_t>(character.harmonics);
  h.flags = flags_of(character);
  const FigureFrame& figure = character.figure;
  h.figure_centre[0] = figure.centre.x, h.figure_centre[1] = figure.centre.y;
  h.figure_dir[0] = figure.dir.x, h.figure_dir[1] = figure.dir.y;
  h.deformer = static_cast<uint32_t>(character.deformer);
  h.vertex_count = static_cast<uint32_t>(character.vertices.size());
  h.triangle_count = static_cast<uint32_t>(character.triangles.size() / 3);
  h.texture_width = static_cast<uint32_t>(character.texture.width);
  h.texture_height = static_cast<uint32_t>(character.texture.height);

  std::vector<std::byte> bytes(sizeof h);
  const std::vector<Vec2> controls = control_section(character);
  h.controls_offset = append(bytes, controls.data(), controls.size() * sizeof(Vec2));
  const std::vector<float> confidences = confidence_section(character, controls.size());
  h.confidences_offset = append(bytes, confidences.data(), confidences.size() * sizeof(float));
  h.vertices_offset = append(bytes, character.vertices.data(), character.vertices.size_bytes());
  if (character.solid()) {
    h.heights_offset = append(bytes, character.heights.data(), character.heights.size_bytes());
    h.normals_offset = append(bytes, character.normals.data(), character.normals.size_bytes());
  }
  h.texcoords_offset = append(bytes, character.texcoords.data(), character.texcoords.size_bytes());
  h.triangles_offset = append(bytes, character.triangles.data(), character.triangles.size_bytes());
  const std::size_t row = std::size_t{4} * h.texture_width;
  if (character.lattice.present()) h.lattice_offset = append_lattice(bytes, character.lattice);
  const std::size_t texture = align_up(bytes.size());
  h.texture_offset = texture;
  bytes.resize(texture + row * h.texture_height);
  for (std::size_t y = 0; y < h.texture_height; ++y) {
    std::memcpy(bytes.data() + texture + y * row,
                character.texture.pixels + y * static_cast<std::size_t>(character.texture.stride), row);
  }
  h.file_bytes = bytes.size();
  std::memcpy(bytes.data(), &h, sizeof h);
  h.checksum = hash_bytes(bytes.data() + kChecksumFrom, bytes.size() - kChecksumFrom);
  std::memcpy(bytes.data(), &h, sizeof h);
  return bytes;
}

void write_character_file(const std::string& path, std::span<const std::byte> bytes) {
  const std::string partial = path + ".part";
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(partial, path, error);
  if (!out || error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw UserError("cannot write the character to " + path + ": check the folder, its rights and the free space");
  }
}

LoadedCharacter::LoadedCharacter(const std::string& path, const Limits& limits) : file_(MappedFile::open(path)) {
  if (!file_) throw UserError("cannot read the character " + path + ": no such file, or no right to read it");
  open(file_->bytes(), path, limits);
}

LoadedCharacter::LoadedCharacter(std::span<const std::byte> bytes, const std::string& name, const Limits& limits)
    : memory_(bytes.size() + 1) {  // nothing has a place too
  std::copy(bytes.begin(), bytes.end(), memory_.bytes().begin());
  open(memory_.bytes().first(bytes.size()), name, limits);
}

void LoadedCharacter::open(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
  const Result<Character> opened = open_character(bytes, limits);
  if (!opened.ok()) throw UserError(name + ": " + opened.status().message);
  character_ = opened.value();
}

}  // namespace nt
