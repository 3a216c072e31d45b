// SPDX-License-Identifier: Apache-2.0
// A character's lattice as the renderer takes it (core/scene/scene.h, LatticeSkin): the part that never changes.
#pragma once
#include <cstdint>
#include <vector>

#include "core/character/character.h"
#include "core/scene/scene.h"

namespace nt {

class CharacterSkin {
 public:
  // The character must outlive it; it has a lattice.
  explicit CharacterSkin(const Character& character);
  // Without what changes from frame to frame; views what this and the character own. `id`: a slot of the renderer's.
  LatticeSkin view(uint32_t id) const;

 private:
  const Character* character_;
  std::vector<uint16_t> corners_;
  std::vector<float> weights_;
  float low_ = 0, high_ = 1;
};

}  // namespace nt
