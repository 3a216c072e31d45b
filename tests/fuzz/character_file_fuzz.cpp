// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: any bytes as a character file. Built with -DNEONTETRA_FUZZ=ON and Clang; run it with a folder of character
// files as its corpus. The checksum is made right first, so that the checks behind it are reached.
#include <cstring>

#include "core/base/hash.h"
#include "core/character/character.h"
#include "core/character/character_format.h"
#include "core/deform/lattice.h"
#include "tests/support/block.h"
#include "tests/support/solve_once.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  nt::test::Block block(size + 1);
  const std::span<std::byte> bytes = block.span().first(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  if (size >= sizeof(nt::CharacterHeader)) {
    const uint64_t checksum = nt::hash_bytes(bytes.data() + nt::kChecksumFrom, size - nt::kChecksumFrom);
    std::memcpy(bytes.data() + offsetof(nt::CharacterHeader, checksum), &checksum, sizeof checksum);
  }
  const auto opened = nt::open_character(bytes, nt::Limits{});
  if (!opened.ok()) return 0;
  // Whatever is accepted can be walked over.
  const nt::Character& c = opened.value();
  float sum = 0;
  for (const uint32_t i : c.triangles) sum += c.vertices[i].x + c.texcoords[i].y;
  for (std::size_t i = 0; i < c.heights.size(); ++i) sum += c.heights[i] + c.normals[i].z;
  for (int y = 0; y < c.texture.height; ++y)
    sum += c.texture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(c.texture.stride)];
  if (c.lattice.present()) sum += nt::test::solve_once(c.lattice);
  static volatile float sink = 0;
  sink = sum;
  return 0;
}
