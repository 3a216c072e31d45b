// SPDX-License-Identifier: Apache-2.0
// The target's blob -> the whole fish, at full detail inside its own neighbourhood.
//
// The opened mask finds the fish but loses thin tails and half-transparent fins. So inside the blob's grown box every
// pixel that differs from the background by more than noise (the weak mask) and hangs together with the blob is taken back
// (hysteresis), and what Otsu and the colour of the difference call shadow is taken away.
// luma, background estimate, blob and its runs -> mask in box coordinates.
// Differs from [F] section 4, which applies Otsu to the box's luma: here it works on |luma - background| and only
// where the two classes separate and the far class has the fish's own sign or the near one keeps the ground's texture.
// Cost: O(box), about 0.08 ms for a 300 x 200 box.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/image_view.h"
#include "core/segment/background.h"
#include "core/segment/blobs.h"

namespace nt {

struct FishMask {
  Box box;         // in the frame; x0 is a multiple of 64, so its words are words of the frame's masks
  BitMask mask;    // box coordinates
  BitMask around;  // the fish and what hangs together with it (its shadow), grown: not to be learned as background
  bool shadow_removed = false;
  // Noise or a restless ground is as strong as a half-transparent fin: the mask may end where the caudal fin begins.
  bool fins_may_hide = false;
};

class Refine {
 public:
  static Refine* create(Arena& arena, const Limits& limits);
  // `blob` and `runs` are of the opened mask; `label` is the blob's. `remove_shadow`: the scene can have shadows. `model`
  // (may be null) is asked whether what differs from the estimate is yet familiar to it.
  FishMask fish(LumaView luma, LumaView background, float noise_sigma, const Blob& blob, int label,
                std::span<const Run> runs, bool remove_shadow, const Background* model = nullptr);
  bool runs_dropped() const { return runs_dropped_; }    // more than Limits::max_runs in the box
  bool blobs_dropped() const { return blobs_dropped_; }  // more than kPartsPerBlob x Limits::max_blobs

 private:
  FishMask fish_in(const Box& box, LumaView luma, LumaView background, float noise_sigma, int label,
                   std::span<const Run> runs, bool remove_shadow, const Background* model);
  bool reaches_border(const BitMask& mask) const;
  void paint_seeds(std::span<const Run> runs, int label, const Box& box, const BitMask& seeds);
  bool keep_connected(const BitMask& candidates, const BitMask& seeds, const BitMask& out);
  bool find_shadow(LumaView luma, LumaView background, const BitMask& fish, const BitMask& seeds, const BitMask& bright,
                   const BitMask& dark, const BitMask& shadow) const;

  void grow(const BitMask& mask, const BitMask& scratch) const;

  std::span<uint64_t> words_[7];
  std::span<uint8_t> blurred_;
  Blobs* blobs_ = nullptr;  // of the weak mask in the box
  bool runs_dropped_ = false, blobs_dropped_ = false;
};

}  // namespace nt
