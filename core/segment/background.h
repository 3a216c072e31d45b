// SPDX-License-Identifier: Apache-2.0
// The seam behind which background models live: luma -> mask of what is not background, and an estimate of the
// background's luma where somebody asks for it.
//
// Models: `vibe` and `vibe_colour` (Barnich and Van Droogenbroeck 2011, [F] section 4; patented in places until 2027-2028, see
// docs/BACKGROUND.md), `still` (an empty-tank picture or the median of the first frames, then a sigma-delta update:
// unpatented, same cost), `backlit` (a smooth surface fitted to a bright or dark even field, and a threshold).
// Memory: vibe and still keep 21 bytes a pixel (still's 20 are for learning), vibe_colour 31.5, backlit 1.
// Cost: one pass over the rows; 0.1-0.5 ms at 960x544 and 128-bit lanes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/image_view.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/segment/blobs.h"

namespace nt {

enum class BackgroundKind : uint8_t { vibe, still, backlit, vibe_colour };

struct BackgroundSettings {
  BackgroundKind kind = BackgroundKind::vibe;
  // 0: estimated from the noise of the first frames, between 10 and 48 (20 at ordinary noise, [F]'s and ViBe's value).
  int radius = 0;
};

class Background {
 public:
  static Result<Background*> create(Arena& arena, const Limits& limits, const BackgroundSettings& settings, int width,
                                    int height, uint64_t seed);
  virtual const char* name() const = 0;
  // Before the first frame: one picture of the scene to learn from. Up to kLearnFrames are kept, later ones are ignored.
  virtual void learn(LumaView luma) = 0;
  // Forget everything; the next frame starts anew. What its `keep` covers is then filled from the ground beside it.
  virtual void restart() = 0;
  // False until something has been learned: the next frame will only be learned from.
  virtual bool ready() const = 0;
  // Chroma of the frame that the next apply is about (core/frame/frame.h); empty views where there is none.
  virtual void see_chroma(LumaView cb, LumaView cr) { static_cast<void>(cb), static_cast<void>(cr); }
  // Mask of foreground. Pixels of `keep` (may be null) are never learned: the tracked fish of the last frame.
  // False when the model only learned from this frame and the mask (then empty) means nothing.
  virtual bool apply(LumaView luma, const BitMask* keep, const BitMask& foreground) = 0;
  // The model was multiplied by a change of the light in the last apply, and so stayed valid.
  virtual bool relit() const = 0;
  // A second look at a part of the frame (its left edge a multiple of 64), where luma that differs from the estimate by
  // `threshold` is not yet news: clears those bits of `differing` whose pixels the model has seen like that before. Ground
  // that strays more than the camera's noise, under a moving surface, is given more room. A single plane has nothing to add.
  virtual void clear_familiar(LumaView part, int x0, int y0, int threshold, const BitMask& differing) const {
    static_cast<void>(part), static_cast<void>(x0), static_cast<void>(y0), static_cast<void>(threshold);
    static_cast<void>(differing);
  }
  // Takes the pixels of one blob for background as they are now: they were a ghost.
  virtual void absorb(LumaView luma, std::span<const Run> runs, int label) = 0;
  // What the picture would show without the fish, whole frame; valid after the first apply.
  virtual LumaView estimate() const = 0;
  // Standard deviation of the difference between luma and estimate() where there is no fish, grey levels.
  virtual float noise_sigma() const = 0;
  // A tank lit from below casts no shadows.
  virtual bool can_have_shadows() const = 0;

 protected:
  ~Background() = default;
};

inline constexpr int kLearnFrames = 20;

}  // namespace nt
