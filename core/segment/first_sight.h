// SPDX-License-Identifier: Apache-2.0
// Fish that are there in the very first frame: luma -> a mask of what stands out from the ground like a fish.
//
// A model that is learned from a picture with a fish in it learns the fish, and one that holds its place is never seen
// again. So before that first frame is learned, blobs that stand out from a smooth surface through the ground, by more than the
// ground's own roughness, and that are elongated, filled and clear of the frame's edge are taken for fish; the model fills
// what is under them from the ground beside them. Right guesses are foreground from the second frame on. Wrong ones, stones,
// give themselves away by not moving: after kTrialFrames without a sign of life they are background.
// Source: none, ours; the surface is field.h's. Cost: about 6 ms in the first frame, then a look at a few numbers a frame.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/segment/blobs.h"

namespace nt {

class FirstSight {
 public:
  static constexpr int kMostFish = 8;
  static constexpr int kTrialFrames = 90;

  // Paints every fish-like blob, grown by what fins and tail may add, into `fish` (cleared first) and returns how many
  // there are. `raw` and `scratch` are scratch of the same size; `blobs` is overwritten.
  int find(LumaView luma, int min_area_px, Blobs& blobs, const BitMask& raw, const BitMask& scratch,
           const BitMask& fish);
  // Once a frame, with that frame's blobs: the index of a blob that was taken for a fish and has not stirred, or -1.
  int lifeless(std::span<const Blob> blobs);

 private:
  struct Suspect {
    Box box;           // of the blob in the first frame
    Vec2 least, most;  // of its centroid since
    int least_area = 0, most_area = 0;
    int seen = 0;
  };
  std::array<Suspect, kMostFish> suspects_{};
  int count_ = 0;
  int frames_ = 0;
};

}  // namespace nt
