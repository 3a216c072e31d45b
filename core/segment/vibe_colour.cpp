// SPDX-License-Identifier: Apache-2.0
#include "core/segment/vibe_colour.h"

#include "core/segment/lanes.h"

namespace nt {
namespace {

BitMask take_mask(Arena& arena, int width, int height) {
  const int words = words_for(width);
  auto space = arena.take<uint64_t>(static_cast<std::size_t>(words) * static_cast<std::size_t>(height));
  return {space.data(), width, height, words};
}

// Bits 0, 2, 4, ... of a word, side by side.
uint64_t even_bits(uint64_t w) {
  w &= 0x5555555555555555ull;
  w = (w | w >> 1) & 0x3333333333333333ull;
  w = (w | w >> 2) & 0x0f0f0f0f0f0f0f0full;
  w = (w | w >> 4) & 0x00ff00ff00ff00ffull;
  w = (w | w >> 8) & 0x0000ffff0000ffffull;
  return (w | w >> 16) & 0x00000000ffffffffull;
}

// Each of the low 32 bits twice.
uint64_t doubled_bits(uint64_t w) {
  w &= 0x00000000ffffffffull;
  w = (w | w << 16) & 0x0000ffff0000ffffull;
  w = (w | w << 8) & 0x00ff00ff00ff00ffull;
  w = (w | w << 4) & 0x0f0f0f0f0f0f0f0full;
  w = (w | w << 2) & 0x3333333333333333ull;
  w = (w | w << 1) & 0x5555555555555555ull;
  return w | w << 1;
}

}  // namespace

void halve_mask(const BitMask& from, const BitMask* also, const BitMask& half) {
  for (int y = 0; y < half.height; ++y) {
    const int below = min_int(2 * y + 1, from.height - 1);
    const auto word = [&](int i) {
      if (i >= from.words_per_row) return uint64_t{0};
      uint64_t w = from.row(2 * y)[i] | from.row(below)[i];
      if (also != nullptr) w |= also->row(2 * y)[i] | also->row(below)[i];
      return even_bits(w | w >> 1);
    };
    for (int i = 0; i < half.words_per_row; ++i) half.row(y)[i] = word(2 * i) | word(2 * i + 1) << 32;
  }
}

void add_doubled(const BitMask& half, const BitMask& other_half, const BitMask& to) {
  for (int y = 0; y < to.height; ++y) {
    const uint64_t *a = half.row(y / 2), *b = other_half.row(y / 2);
    for (int i = 0; i < to.words_per_row; ++i) {
      const uint64_t both = a[i / 2] | b[i / 2];
      to.row(y)[i] |= doubled_bits(i % 2 == 0 ? both : both >> 32) & valid_bits(64 * i, to.width);
    }
  }
}

VibeColour* VibeColour::create(Arena& arena, const BackgroundSettings& settings, int width, int height, uint64_t seed) {
  const int w = (width + 1) / 2, h = (height + 1) / 2;
  auto self = arena.take<VibeColour>(1);
  Vibe* luma = Vibe::create(arena, settings, width, height, seed);
  Vibe* cb = Vibe::create(arena, settings, w, h, seed + 1);
  Vibe* cr = Vibe::create(arena, settings, w, h, seed + 2);
  const BitMask frozen = take_mask(arena, w, h), cb_new = take_mask(arena, w, h), cr_new = take_mask(arena, w, h);
  if (self.empty() || luma == nullptr || cb == nullptr || cr == nullptr || cr_new.words == nullptr) return nullptr;
  VibeColour& model = self[0];
  model.luma_ = luma, model.cb_ = cb, model.cr_ = cr;
  model.frozen_ = frozen, model.cb_new_ = cb_new, model.cr_new_ = cr_new;
  return &model;
}

void VibeColour::restart() {
  for (Vibe* channel : {luma_, cb_, cr_}) channel->restart();
}

bool VibeColour::has_chroma() const {
  return cb_seen_.width == frozen_.width && cb_seen_.height == frozen_.height && cr_seen_.width == frozen_.width &&
         cr_seen_.height == frozen_.height;
}

bool VibeColour::apply(LumaView luma, const BitMask* keep, const BitMask& foreground) {
  const bool means_something = luma_->apply(luma, keep, foreground);
  if (!has_chroma()) return means_something;
  halve_mask(foreground, keep, frozen_);
  cb_->apply(cb_seen_, &frozen_, cb_new_);
  cr_->apply(cr_seen_, &frozen_, cr_new_);
  if (means_something) add_doubled(cb_new_, cr_new_, foreground);
  return means_something;
}

void VibeColour::absorb(LumaView luma, std::span<const Run> runs, int label) {
  luma_->absorb(luma, runs, label);
  if (!has_chroma()) return;
  for (const Run& run : runs) {
    if (run.label != label) continue;
    const Run half{static_cast<int16_t>(run.y / 2), static_cast<int16_t>(run.x0 / 2),
                   static_cast<int16_t>((run.x1 + 1) / 2), label};
    cb_->absorb(cb_seen_, {&half, 1}, label);
    cr_->absorb(cr_seen_, {&half, 1}, label);
  }
}

}  // namespace nt
