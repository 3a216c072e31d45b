// SPDX-License-Identifier: Apache-2.0
#include "app/actor.h"

#include <algorithm>

#include "app/ui/posed_character.h"
#include "core/motion/inbetween.h"

namespace nt {
namespace {

constexpr int kHeldFrames = 3;  // a frame or two without a pose is ordinary: nothing is shown of it
constexpr int kFadingFrames = 10;
constexpr float kFadedAlpha = 0.35f;

}  // namespace

Actor::Actor(const Wardrobe& wardrobe, std::size_t costume, float size)
    : wardrobe_(&wardrobe), costume_(costume), size_(size), fittings_(wardrobe.size()) {
  Arena measuring;
  for (std::size_t i = 0; i < wardrobe.size(); ++i) (void)wardrobe.fitting(i, measuring);
  memory_ = AlignedBlock(measuring.used());
  Arena arena(memory_.bytes());
  for (std::size_t i = 0; i < wardrobe.size(); ++i) {
    fittings_[i] = wardrobe.fitting(i, arena);
    const CharacterSkin* skin = wardrobe.skin(i);
    if (skin != nullptr) packed_.resize(std::max(packed_.size(), 12 * skin->view(0).rest.size()));
  }
}

void Actor::wear(std::size_t costume) {
  if (costume == costume_) return;
  costume_ = costume;
  if (init_len_ > 0) fittings_[costume_]->start(size_ * init_len_);
  after_gap_ = true;
  posed_ = false;
}

void Actor::see(const Sighting& sighting) {
  seen_ = sighting.seen;
  if (!sighting.seen) {
    previous_ = current_;
    ++missed_;
    return;
  }
  const bool anew = sighting.init_len != init_len_;  // the first pose, or another fish
  if (anew) {
    init_len_ = sighting.init_len;
    fittings_[costume_]->start(size_ * init_len_);
  }
  // After a gap the drawing appears where the fish is: it does not sweep across in one frame.
  const bool gap = anew || missed_ > 0;
  previous_ = gap ? sighting.motion : current_;
  after_gap_ = after_gap_ || gap;
  current_ = sighting.motion;
  missed_ = 0;
}

float Actor::zoom(const Pane& pane) const { return size_ * init_len_ / retarget().lengths().body_len * pane.scale; }

void Actor::pose(float t, float dt_s, const Pane& pane) {
  if (init_len_ <= 0) return;
  const Motion motion = t < 1 ? in_between(previous_, current_, t) : current_;
  Placement placement;
  placement.zoom = zoom(pane);
  placement.offset = pane.to_scene({0, 0});
  fittings_[costume_]->pose(motion, after_gap_ ? 0 : dt_s, placement);
  after_gap_ = false;
  posed_ = true;
  if (retarget().renderer_places()) pack();
}

void Actor::pack() {
  Retarget& posed = *fittings_[costume_];
  skin_ = wardrobe_->skin(costume_)->view(kFirstCharacterPicture + static_cast<uint32_t>(costume_));
  const std::span<float> out(packed_.data(), 12 * skin_.rest.size());
  posed.lattice()->pack(out);
  skin_.lattice = out, skin_.origin = posed.origin(), skin_.up = posed.up();
}

void Actor::draw(Scene& scene) const {
  if (!posed_) return;
  const float gone = static_cast<float>(std::clamp(missed_ - kHeldFrames, 0, kFadingFrames)) / kFadingFrames;
  const Colour tint{1, 1, 1, 1 + (kFadedAlpha - 1) * gone};
  const uint32_t id = kFirstCharacterPicture + static_cast<uint32_t>(costume_);
  if (!retarget().renderer_places()) {
    add_posed(scene, character(), retarget(), id, tint);
    return;
  }
  Picture texture = character().texture;
  texture.id = id;
  scene.solid(texture, skin_, tint);
}

}  // namespace nt
