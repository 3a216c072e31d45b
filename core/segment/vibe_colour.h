// SPDX-License-Identifier: Apache-2.0
// ViBe on luma and chroma: a pixel is foreground where its luma, or the colour
// of its 2 x 2 block, is new.
//
// Three models of vibe.h, one a channel: luma at full size, Cb and Cr at half.
// Each channel matches by itself and has its own noise and radius, so a fish of
// the ground's brightness is found by its colour, and grey water costs no
// accuracy. Differs from the paper's colour variant (one distance over R, G,
// B): the channels vote by "or", because video carries chroma at half size and
// far less of it. What one channel calls foreground is not learned by the
// chroma models. Frames without chroma (a grey camera) are judged by luma
// alone. Memory: 21 bytes a pixel of luma and 10.5 for the chroma. Cost: half
// as much again as vibe.
#pragma once
#include <span>

#include "core/segment/vibe.h"

namespace nt {

class VibeColour final : public Background {
 public:
  static VibeColour* create(Arena& arena, const BackgroundSettings& settings, int width, int height, uint64_t seed);
  VibeColour() = default;

  const char* name() const override { return "vibe-colour"; }
  void learn(LumaView luma) override { luma_->learn(luma); }
  void restart() override;
  bool ready() const override { return luma_->ready(); }
  void see_chroma(LumaView cb, LumaView cr) override { cb_seen_ = cb, cr_seen_ = cr; }
  bool apply(LumaView luma, const BitMask* keep, const BitMask& foreground) override;
  void absorb(LumaView luma, std::span<const Run> runs, int label) override;
  LumaView estimate() const override { return luma_->estimate(); }
  float noise_sigma() const override { return luma_->noise_sigma(); }
  bool relit() const override { return luma_->relit(); }
  void clear_familiar(LumaView part, int x0, int y0, int threshold, const BitMask& differing) const override {
    luma_->clear_familiar(part, x0, y0, threshold, differing);
  }
  bool can_have_shadows() const override { return true; }

 private:
  bool has_chroma() const;

  Vibe *luma_ = nullptr, *cb_ = nullptr, *cr_ = nullptr;
  LumaView cb_seen_, cr_seen_;  // of the frame at hand
  BitMask frozen_, cb_new_,
      cr_new_;  // half size; frozen_: not to be learned by the chroma models
};

// A mask of half the size, rounded up: a bit is set where any of its 2 x 2
// pixels is; `also` may be null.
void halve_mask(const BitMask& from, const BitMask* also, const BitMask& half);
// Sets the 2 x 2 pixels of each bit of either half mask.
void add_doubled(const BitMask& half, const BitMask& other_half, const BitMask& to);

}  // namespace nt
