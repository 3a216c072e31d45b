// SPDX-License-Identifier: Apache-2.0
// The lattice in the bytes of a character file: checked and viewed in place, without parsing or copying.
//
// Input: the file's bytes on a 64-byte line and its header. Output: Character::lattice, of which every index, count and
// number has been checked (check_lattice, check_embedding), so that the solver may trust it; or one line.
// Cost: O(lattice), about 0.2 ms for 600 vertices.
#pragma once
#include <cstddef>
#include <span>

#include "core/base/arena.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/character/character.h"
#include "core/character/character_format.h"

namespace nt {

// A section of `count` elements of T at `offset`, or an empty span when it does not lie inside the file.
template <class T>
std::span<const T> section(std::span<const std::byte> bytes, uint64_t offset, uint64_t count) {
  const uint64_t size = bytes.size();
  if (offset % kAlignment != 0 || offset < sizeof(CharacterHeader) || offset > size) return {};
  if (count > (size - offset) / sizeof(T)) return {};
  return {reinterpret_cast<const T*>(bytes.data() + offset), static_cast<std::size_t>(count)};
}

// Nothing where the header names no lattice. The character's vertices and heights have been read.
Status read_lattice(std::span<const std::byte> bytes, const CharacterHeader& header, const Limits& limits,
                    Character& character);

}  // namespace nt
