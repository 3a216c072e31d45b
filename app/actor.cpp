// SPDX-License-Identifier: Apache-2.0
#include "app/actor.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "app/author/mesh_character.h"
#include "app/author/mesh_file.h"
#include "app/author/picture_character.h"
#include "core/character/character_format.h"
#include "core/motion/inbetween.h"

namespace nt {
namespace {

constexpr int kHeldFrames = 3;  // a frame or two without a pose is ordinary: nothing is shown of it
constexpr int kFadingFrames = 10;
constexpr float kFadedAlpha = 0.35f;

bool is_character_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[sizeof kCharacterMagic] = {};
  file.read(magic, sizeof magic);
  return std::equal(std::begin(magic), std::end(magic), kCharacterMagic);
}

}  // namespace

LoadedCharacter load_character(const std::string& path) {
  if (is_character_file(path) || path.ends_with(".ntchar")) return LoadedCharacter(path, Limits{});
  const AuthoredCharacter authored =
      is_mesh_file(path) ? author_mesh(path, MeshOptions{}) : author_picture(path, PictureOptions{});
  for (const std::string& note : authored.report.notes) std::fprintf(stderr, "%s: %s\n", path.c_str(), note.c_str());
  return LoadedCharacter(authored.bytes, path, Limits{});
}

Actor::Actor(const std::string& path) : character_(load_character(path)) {
  RetargetSettings settings;
  settings.mls = character_.character().deformer;
  Arena measuring;
  (void)Retarget::create(measuring, character_.character(), settings);
  memory_ = AlignedBlock(measuring.used());
  Arena arena(memory_.bytes());
  Result<Retarget*> made = Retarget::create(arena, character_.character(), settings);
  if (!made.ok()) throw UserError(path + ": " + made.status().message);
  retarget_ = made.value();
}

void Actor::see(Session& session) {
  Capture& capture = session.capture();
  if (session.report().status != PoseStatus::ok) {
    previous_ = current_;
    ++missed_;
    return;
  }
  const bool anew = capture.init_len() != init_len_;  // the first pose, or another fish
  if (anew) {
    init_len_ = capture.init_len();
    retarget_->start(init_len_);
  }
  // After a gap the drawing appears where the fish is: it does not sweep across in one frame.
  const bool gap = anew || missed_ > 0;
  previous_ = gap ? capture.motion() : current_;
  after_gap_ = after_gap_ || gap;
  current_ = capture.motion();
  missed_ = 0;
}

void Actor::pose(float t, float dt_s, const Pane& pane) {
  if (init_len_ <= 0) return;
  Placement placement;
  placement.zoom = init_len_ / retarget_->lengths().body_len * pane.scale;
  placement.offset = pane.to_scene({0, 0});
  retarget_->pose(t < 1 ? in_between(previous_, current_, t) : current_, after_gap_ ? 0 : dt_s, placement);
  after_gap_ = false;
  posed_ = true;
}

void Actor::draw(Scene& scene) const {
  if (!posed_) return;
  const float gone = static_cast<float>(std::clamp(missed_ - kHeldFrames, 0, kFadingFrames)) / kFadingFrames;
  const Character& character = character_.character();
  Picture texture = character.texture;
  texture.id = kCharacterPicture;
  scene.mesh(texture, retarget_->vertices(), character.texcoords, character.triangles,
             {1, 1, 1, 1 + (kFadedAlpha - 1) * gone});
}

}  // namespace nt
