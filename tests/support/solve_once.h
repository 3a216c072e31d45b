// SPDX-License-Identifier: Apache-2.0
// Whatever lattice a character file is accepted with can be solved and embedded: a step away from its rest pose.
#pragma once
#include <vector>

#include "core/character/character.h"
#include "core/deform/lattice.h"
#include "tests/support/block.h"

namespace nt::test {

inline float solve_once(const CharacterLattice& l) {
  Arena measure;
  PhongEmbedding::create(measure, l.embedding, l.view);
  Block block(Lattice::bytes_needed(l.view) + measure.used());
  Arena arena(block.span());
  const auto made = Lattice::create(arena, l.view, {});
  PhongEmbedding* phong = PhongEmbedding::create(arena, l.embedding, l.view);
  if (!made.ok() || phong == nullptr) return 0.0f;
  std::vector<Vec3> markers(l.view.markers.size(), Vec3{1, 2, 3});
  const std::vector<uint8_t> seen(markers.size(), 1);
  (void)made.value()->step(markers, seen);
  std::vector<float> places(12 * l.embedding.blocks());
  phong->embed(made.value()->vertices(), places);
  embed_linear(l.embedding, l.view, made.value()->vertices(), places);
  float sum = 0.0f;
  for (const uint32_t slot : l.slots) sum += places[3 * slot];
  for (const char c : l.names) sum += static_cast<float>(c);
  return sum;
}

}  // namespace nt::test
