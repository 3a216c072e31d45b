// SPDX-License-Identifier: Apache-2.0
#include "app/wardrobe.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "app/author/character_lattice.h"
#include "app/author/mesh_character.h"
#include "app/author/mesh_file.h"
#include "app/author/picture_character.h"
#include "core/character/character_format.h"
#include "platform/camera.h"

namespace nt {
namespace {

bool is_character_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[sizeof kCharacterMagic] = {};
  file.read(magic, sizeof magic);
  return std::equal(std::begin(magic), std::end(magic), kCharacterMagic);
}

bool has_swimmers_lattice(const Character& c) {
  return c.lattice.present() && c.lattice.drive == LatticeDrive::landmarks;
}

LoadedCharacter with_lattice(LoadedCharacter file, const std::string& path) {
  const LatticeAsset lattice = fish_lattice(file.character(), {kFishLatticeVertices, LatticeForm::arap});
  std::fprintf(stderr, "%s: %s\n", path.c_str(), describe(lattice).c_str());
  Character character = file.character();
  character.lattice = lattice.view();
  return LoadedCharacter(character_bytes(character), path, Limits{});
}

}  // namespace

LoadedCharacter load_character(const std::string& path) {
  if (is_character_file(path) || path.ends_with(".ntchar")) return LoadedCharacter(path, Limits{});
  const AuthoredCharacter authored =
      is_mesh_file(path) ? author_mesh(path, MeshOptions{}) : author_picture(path, PictureOptions{});
  for (const std::string& note : authored.report.notes) std::fprintf(stderr, "%s: %s\n", path.c_str(), note.c_str());
  return LoadedCharacter(authored.bytes, path, Limits{});
}

Wardrobe::Wardrobe(const std::vector<std::string>& paths, std::optional<MlsKind> mls, std::optional<Deformer> deformer,
                   bool renderer_places) {
  costumes_.reserve(paths.size());  // skins view their characters
  bool any_lattice = false;
  for (const std::string& path : paths) {
    Costume& costume = costumes_.emplace_back(Costume{path, load_character(path), {}, nullptr, nullptr});
    if (deformer == Deformer::lattice && costume.file.character().solid() &&
        !has_swimmers_lattice(costume.file.character())) {
      costume.file = with_lattice(std::move(costume.file), path);
    }
    RetargetSettings settings;
    const bool lattice = deformer != Deformer::mls && has_swimmers_lattice(costume.file.character());
    settings.deformer = lattice ? Deformer::lattice : Deformer::mls;
    settings.vertices = !(lattice && renderer_places);
    if (!settings.vertices) costume.skin = std::make_unique<CharacterSkin>(costume.file.character());
    any_lattice = any_lattice || lattice;
    settings.mls = mls.value_or(costume.file.character().deformer);
    Arena measuring;
    (void)Retarget::create(measuring, costume.file.character(), settings);
    costume.memory = AlignedBlock(measuring.used());
    Arena arena(costume.memory.bytes());
    const Result<Retarget*> made = Retarget::create(arena, costume.file.character(), settings);
    if (!made.ok()) throw UserError(path + ": " + made.status().message);
    costume.prepared = made.value();
  }
  if (deformer == Deformer::lattice && !any_lattice) {
    throw UserError("--deformer lattice is for 3D characters, and there is none; leave it out", 2);
  }
}

Retarget* Wardrobe::fitting(std::size_t index, Arena& arena) const {
  const Result<Retarget*> made = Retarget::twin(arena, *costumes_[index].prepared);
  if (!made.ok()) throw UserError(costumes_[index].path + ": " + made.status().message);
  return made.value();
}

}  // namespace nt
