// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/observation_ring.h"

namespace nt {

bool ObservationRing::add(const Observation& seen, const Keep& what) {
  Slot* slot = seen_.free_slot();
  if (slot == nullptr) return false;
  const bool has_picture = what.picture && seen.picture.pixels != nullptr;
  std::vector<uint8_t>* pixels = has_picture ? pixels_.free_slot() : nullptr;
  if (has_picture && pixels == nullptr) ++pictures_lost_;
  slot->seen.keep(seen, what, pixels);
  slot->has_pixels = pixels != nullptr;
  if (pixels != nullptr) pixels_.push();
  seen_.push();
  last_has_pixels_ = pixels != nullptr;
  return true;
}

bool ObservationRing::add_newest(const Observation& seen, const Keep& what) {
  if (add(seen, what)) return true;
  if (!seen_.take_back()) return false;
  if (last_has_pixels_) pixels_.take_back();
  add(seen, what);
  return false;
}

const Observation* ObservationRing::next() {
  if (seen_.size() < (held_ != nullptr ? 2u : 1u)) return nullptr;
  let_go();
  held_ = seen_.oldest();
  return &held_->seen.view();
}

void ObservationRing::let_go() {
  if (held_ == nullptr) return;
  if (held_->has_pixels) pixels_.pop();
  held_ = nullptr;
  seen_.pop();
}

void ObservationRing::close() {
  seen_.close();
  pixels_.close();
}

}  // namespace nt
