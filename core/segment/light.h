// SPDX-License-Identifier: Apache-2.0
// The scene's light: by what factor it has changed since a background model was learned, and what to do about it.
//
// luma -> factors. A lamp that is switched on, an exposure that settles or drifts multiply the whole picture; a model of
// absolute grey levels then sees foreground everywhere, or, where a fish is protected from being learned, a ring around it.
// Method: on a fixed grid of at most 40 x 24 pixels the median of luma / first luma. It moves with the light alone, as fish
// and gravel that was shifted stay under half of the grid, and it counts where most of the grid agrees. The model's owner multiplies what it remembers by what
// update() says: all of it after a jump (slow light it follows by itself), the pixels that it may not learn after each
// small step.
// A change that is not one factor for all (a lamp at one side) is left to the flood test, which learns anew.
// Memory: 8 KB. Cost: 960 pixel reads a frame, about 4 us.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image_view.h"

namespace nt {

struct Relight {
  float all = 1.0f;   // to be multiplied on everything that is remembered; 1: nothing to do
  float kept = 1.0f;  // after that, on the pixels that are kept from being learned ...
  float rounding =
      0.5f;  // ... with this added before it is cut to whole levels: it changes, so that steps do not add up their errors
};

class Light {
 public:
  void start(LumaView luma);  // the model is being learned from this picture
  Relight update(LumaView luma, bool keeps_pixels);
  // How far the ground's own luma strays over time once the common factor is taken out (noise, but also caustics and
  // ripples): standard deviation, grey levels, over the last frames. 0 before the first update.
  float unrest() const { return unrest_; }

 private:
  static constexpr int kColumns = 40, kRows = 24;
  float level(LumaView luma, bool& agreed);
  std::array<float, static_cast<std::size_t>(kColumns) * kRows> per_first_{};  // 1 / first luma
  float unrest_ = 0.0f;
  float model_ = 1.0f, kept_ = 1.0f;  // light that the model, and its kept pixels, stand for
  float steady_ = 1.0f;               // the light without its flicker
  int steps_ = 0;                     // of the kept pixels
};

// Multiplies pixels by a factor, rounded, at most 255; the second form only where bits of `where` are set.
// `rounding` is added before the fraction is cut off.
void scale_pixels(float factor, std::span<uint8_t> pixels);
void scale_pixels(float factor, float rounding, const BitMask& where, ImageView<uint8_t> plane);

}  // namespace nt
