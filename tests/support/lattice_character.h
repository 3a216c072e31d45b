// SPDX-License-Identifier: Apache-2.0
// A small solid character with a lattice, as the bytes of a character file: DrawnCharacter's grid inside a bar.
#pragma once
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "app/author/character_file.h"
#include "core/base/hash.h"
#include "core/character/character_format.h"
#include "tests/support/drawn_character.h"
#include "tests/support/test_lattice.h"

namespace nt::test {

class LatticeCharacter {
 public:
  LatticeCharacter() : data_(bar(5, 1, 2, 2)), block_(make()) {}
  std::span<std::byte> bytes() { return block_.span(); }
  CharacterHeader header() {
    CharacterHeader h;
    std::memcpy(&h, bytes().data(), sizeof h);
    return h;
  }
  LatticeHeader lattice_header() {
    LatticeHeader h;
    std::memcpy(&h, bytes().data() + header().lattice_offset, sizeof h);
    return h;
  }
  const LatticeData& data() const { return data_; }
  // Makes the checksum right again after a change, so that the checks behind it are reached.
  void seal() {
    const uint64_t sum = hash_bytes(bytes().data() + kChecksumFrom, bytes().size() - kChecksumFrom);
    std::memcpy(bytes().data() + offsetof(CharacterHeader, checksum), &sum, sizeof sum);
  }
  template <class T>
  void put(uint64_t offset, T value) {
    std::memcpy(bytes().data() + offset, &value, sizeof value);
    seal();
  }

 private:
  Block make() {
    DrawnCharacter drawn(true, 3, 15, true);
    Character c = open_character(drawn.bytes(), Limits{}).value();
    const std::size_t vertices = c.vertices.size(), blocks = (vertices + 3) / 4;
    std::vector<float> coordinates(12 * blocks, 0.2f);
    std::vector<uint16_t> tetrahedron;
    std::vector<uint32_t> slots;
    std::string names;
    for (std::size_t b = 0; b < blocks; ++b) {
      tetrahedron.push_back(static_cast<uint16_t>(b * (data_.tetrahedra.size() / 4) / blocks));
    }
    for (uint32_t v = 0; v < vertices; ++v) slots.push_back(v);
    for (std::size_t k = 0; k < data_.markers.size() + data_.joint_vertex.size(); ++k) {
      names.append("n").append(std::to_string(k)).push_back('\0');
    }
    c.lattice.view = data_.view();
    c.lattice.embedding = {coordinates, tetrahedron};
    c.lattice.slots = slots;
    c.lattice.names = names;
    const std::vector<std::byte> made = character_bytes(c);
    Block block(made.size());
    std::memcpy(block.span().data(), made.data(), made.size());
    return block;
  }
  LatticeData data_;
  Block block_;
};

}  // namespace nt::test
