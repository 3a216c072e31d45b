// SPDX-License-Identifier: Apache-2.0
// A posed character as a scene item, flat or solid.
#pragma once
#include "core/character/retarget.h"
#include "core/scene/scene.h"

namespace nt {

// `slot`: the texture's Picture.id. Both must live until the scene is drawn.
inline void add_posed(Scene& scene, const Character& character, const Retarget& posed, uint32_t slot, Colour tint) {
  Picture texture = character.texture;
  texture.id = slot;
  if (character.solid()) {
    scene.solid(texture, posed.vertices(), posed.solid().heights(), posed.solid().normals(), character.texcoords,
                character.triangles, tint);
  } else {
    scene.mesh(texture, posed.vertices(), character.texcoords, character.triangles, tint);
  }
}

}  // namespace nt
