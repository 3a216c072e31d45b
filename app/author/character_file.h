// SPDX-License-Identifier: Apache-2.0
// Character -> bytes of a character file (docs/FORMATS.md), and back: a file is mapped and looked at where it lies.
//
// Input: a Character whose spans the caller owns; control points and vertices in character units. Output: bytes that
// core's open_character takes back unchanged; the same input gives the same bytes. Cost: a copy to
// write; to open, one look at every byte for the checksum.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/aligned_block.h"
#include "core/character/character.h"
#include "platform/linux/mapped_file.h"

namespace nt {

std::vector<std::byte> character_bytes(const Character& character);

// Writes all or nothing (through a temporary file beside it). Throws UserError with one line.
void write_character_file(const std::string& path, std::span<const std::byte> bytes);

// A character file, mapped or in memory, and the view onto it.
class LoadedCharacter {
 public:
  // Throws UserError with one line: missing, not a character, damaged, newer.
  LoadedCharacter(const std::string& path, const Limits& limits);
  // From bytes in memory; `name` is for messages.
  LoadedCharacter(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);
  const Character& character() const { return character_; }

 private:
  void open(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);
  std::optional<MappedFile> file_;
  AlignedBlock memory_;  // of one that was given as bytes
  Character character_;
};

}  // namespace nt
