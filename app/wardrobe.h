// SPDX-License-Identifier: Apache-2.0
// The characters of a run: each opened and prepared once, worn by as many actors as there are.
//
// Paths of character files, or of pictures and meshes that are turned into characters on the spot -> prepared characters, in the order
// given. What depends on the rest pose alone is shared by all who wear it. Throws UserError.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/aligned_block.h"
#include "app/author/character_file.h"
#include "app/character_skin.h"
#include "core/character/retarget.h"

namespace nt {

// A character file, or a picture or mesh that is turned into a character on the spot. Throws UserError.
LoadedCharacter load_character(const std::string& path);

class Wardrobe {
 public:
  // Without `mls` each character is deformed as its file says. Without `deformer` those are moved by a lattice whose
  // file has one for a swimmer; with Deformer::lattice every 3D one is, and gets one on the spot where it has none.
  // renderer_places: the GPU places the vertices of those, and only their lattice goes there each frame.
  Wardrobe(const std::vector<std::string>& paths, std::optional<MlsKind> mls,
           std::optional<Deformer> deformer = std::nullopt, bool renderer_places = false);
  std::size_t size() const { return costumes_.size(); }
  const Character& character(std::size_t index) const { return costumes_[index].file.character(); }
  const std::string& path(std::size_t index) const { return costumes_[index].path; }
  const CharacterSkin* skin(std::size_t index) const { return costumes_[index].skin.get(); }  // where the GPU needs it
  // One more that poses this character, in the arena's memory; null when the arena is measuring.
  Retarget* fitting(std::size_t index, Arena& arena) const;

 private:
  struct Costume {
    std::string path;
    LoadedCharacter file;
    AlignedBlock memory;
    std::unique_ptr<CharacterSkin> skin;
    const Retarget* prepared = nullptr;  // lives in memory
  };
  std::vector<Costume> costumes_;
};

}  // namespace nt
