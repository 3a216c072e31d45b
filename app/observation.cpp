// SPDX-License-Identifier: Apache-2.0
#include "app/observation.h"

#include "app/picture_copy.h"
#include "core/base/hash.h"

namespace nt {
const Observation& Observer::look(Session& session, bool picture, bool masks) {
  Capture& capture = session.capture();
  seen_ = {};
  seen_.frame_index = session.frame_index();
  seen_.frame = session.frame();
  seen_.had_ns = session.had_ns();
  seen_.report = session.report();
  const auto count = static_cast<std::size_t>(capture.fish_count());
  for (std::size_t i = 0; i < count; ++i) {
    const int fish = static_cast<int>(i);
    fish_[i] = {capture.pose(fish), capture.motion(fish), capture.init_len(fish), capture.order(fish),
                capture.contour(fish)};
  }
  seen_.fish = {fish_.data(), count};
  seen_.target = capture.target();
  seen_.blobs = capture.blobs();
  if (picture) seen_.picture = session.camera().picture();
  if (masks) seen_.around_fish = capture.around_fish(), seen_.foreground = capture.foreground();
  seen_.truth = session.camera().truth();
  seen_.statistics = &session.statistics();
  return seen_;
}

uint64_t luma_hash(const LumaView& luma) {
  uint64_t hash = kHashSeed;
  for (int y = 0; y < luma.height; ++y) hash = hash_bytes(luma.row(y), static_cast<std::size_t>(luma.width), hash);
  return hash;
}

void KeptObservation::keep(const Observation& seen, const Keep& what, std::vector<uint8_t>* pixels) {
  view_ = seen;
  if (what.luma_hash) view_.luma_hash = luma_hash(seen.frame.luma);
  view_.frame.luma.data = view_.frame.cb.data = view_.frame.cr.data = nullptr;
  fish_.assign(seen.fish.begin(), seen.fish.end());
  for (std::size_t i = 0; i < fish_.size(); ++i) {
    contours_[i].clear();
    if (what.contours) contours_[i].assign(seen.fish[i].contour.begin(), seen.fish[i].contour.end());
    fish_[i].contour = contours_[i];
  }
  view_.fish = fish_;
  blobs_.clear();
  if (what.blobs) blobs_.assign(seen.blobs.begin(), seen.blobs.end());
  view_.blobs = blobs_;
  if (what.picture && pixels != nullptr) view_.picture = copied(seen.picture, *pixels);
  else view_.picture.pixels = nullptr;
  if (!what.masks) view_.around_fish.words = view_.foreground.words = nullptr;
  keep_mask(view_.around_fish, around_fish_);
  keep_mask(view_.foreground, foreground_);
  view_.truth = nullptr;
  if (what.truth && seen.truth != nullptr) view_.truth = &truth_.emplace(*seen.truth);
  view_.statistics = nullptr;
  if (!what.statistics) return;
  if (statistics_ == nullptr) statistics_ = std::make_unique<Statistics>();
  *statistics_ = *seen.statistics;
  view_.statistics = statistics_.get();
}

void KeptObservation::keep_mask(BitMask& mask, std::vector<uint64_t>& words) {
  if (mask.words == nullptr) return;
  const std::size_t count = static_cast<std::size_t>(mask.words_per_row) * static_cast<std::size_t>(mask.height);
  words.assign(mask.words, mask.words + count);
  mask.words = words.data();
}

}  // namespace nt
