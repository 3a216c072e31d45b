// SPDX-License-Identifier: Apache-2.0
#include "core/character/lattice_section.h"

#include <cstring>

namespace nt {
namespace {

Status damaged() {
  return {StatusCode::bad_data,
          "character file is damaged (lattice); make it again with `neontetra character --lattice`"};
}

// Sections of a file, one after the other; `ok` once none lay outside.
class Sections {
 public:
  explicit Sections(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void read(uint64_t offset, uint64_t count, std::span<const T>& to) {
    if (count == 0) return;
    to = section<T>(bytes_, offset, count);
    ok_ = ok_ && !to.empty();
  }
  bool ok() const { return ok_; }

 private:
  std::span<const std::byte> bytes_;
  bool ok_ = true;
};

bool read_arrays(std::span<const std::byte> bytes, const LatticeHeader& h, uint64_t slots, CharacterLattice& l) {
  Sections s(bytes);
  LatticeView& v = l.view;
  v.form = static_cast<LatticeForm>(h.form);
  s.read(h.vertices_offset, h.vertex_count, v.vertices);
  s.read(h.tetrahedra_offset, uint64_t{4} * h.tetrahedron_count, v.tetrahedra);
  s.read(h.neighbour_start_offset, uint64_t{h.vertex_count} + 1, v.neighbour_start);
  s.read(h.neighbours_offset, h.neighbour_count, v.neighbours);
  s.read(h.weights_offset, h.neighbour_count, v.weights);
  s.read(h.column_start_offset, uint64_t{h.vertex_count} + 1, v.column_start);
  s.read(h.rows_offset, h.row_count, v.rows);
  s.read(h.markers_offset, h.marker_count, v.markers);
  s.read(h.joint_vertex_offset, h.joint_count, v.skeleton.vertex);
  s.read(h.joint_parent_offset, h.joint_count, v.skeleton.parent);
  s.read(h.chain_start_offset, uint64_t{h.joint_count} + 1, v.skeleton.chain_start);
  s.read(h.chain_offset, h.chain_count, v.skeleton.chain);
  s.read(h.limits_offset, h.joint_count, v.skeleton.limits);
  s.read(h.coordinates_offset, uint64_t{12} * h.block_count, l.embedding.coordinates);
  s.read(h.block_tetrahedra_offset, h.block_count, l.embedding.tetrahedron);
  s.read(h.slots_offset, slots, l.slots);
  s.read(h.names_offset, h.name_bytes, l.names);
  return s.ok();
}

// A name for each marker and joint, each ended.
bool names_are_sound(const CharacterLattice& l) {
  std::size_t ended = 0;
  for (const char c : l.names) ended += c == 0;
  return ended == l.view.markers.size() + l.view.skeleton.joints() && (l.names.empty() || l.names.back() == 0);
}

}  // namespace

Status read_lattice(std::span<const std::byte> bytes, const CharacterHeader& header, const Limits& limits,
                    Character& character) {
  if (header.lattice_offset == 0) return {};
  const auto at = section<LatticeHeader>(bytes, header.lattice_offset, 1);
  if (at.empty() || header.version < 3 || !character.solid()) return damaged();
  LatticeHeader h;
  std::memcpy(&h, at.data(), sizeof h);
  CharacterLattice& l = character.lattice;
  if (h.form > 1 || h.drive > 1 || h.vertex_count == 0) return damaged();
  l.drive = static_cast<LatticeDrive>(h.drive);
  if (!read_arrays(bytes, h, character.vertices.size(), l) || !names_are_sound(l)) return damaged();
  if (const Status s = check_lattice(l.view, limits); !s.ok()) return s;
  if (const Status s = check_embedding(l.embedding, l.view); !s.ok()) return s;
  for (const uint32_t slot : l.slots) {
    if (slot >= 4 * l.embedding.blocks()) return damaged();
  }
  return {};
}

}  // namespace nt
