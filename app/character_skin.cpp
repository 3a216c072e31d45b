// SPDX-License-Identifier: Apache-2.0
#include "app/character_skin.h"

#include <algorithm>

namespace nt {

CharacterSkin::CharacterSkin(const Character& c) : character_(&c) {
  const CharacterLattice& l = c.lattice;
  for (const uint32_t slot : l.slots) {
    const std::size_t block = slot / 4, lane = slot % 4;
    const auto corner = l.view.tetrahedra.subspan(4u * l.embedding.tetrahedron[block], 4);
    corners_.insert(corners_.end(), corner.begin(), corner.end());
    for (std::size_t k = 0; k < 3; ++k) weights_.push_back(l.embedding.coordinates[12 * block + 4 * k + lane]);
  }
  const auto [low, high] = std::minmax_element(c.heights.begin(), c.heights.end());
  low_ = *low, high_ = *high;
}

LatticeSkin CharacterSkin::view(uint32_t id) const {
  LatticeSkin skin;
  skin.id = id;
  skin.revision = character_->texture.revision;  // the file's checksum
  skin.corners = corners_, skin.weights = weights_;
  skin.rest = character_->lattice.view.vertices;
  skin.normals = character_->normals, skin.texcoords = character_->texcoords;
  skin.triangles = character_->triangles;
  skin.low = low_, skin.high = high_;
  return skin;
}

}  // namespace nt
