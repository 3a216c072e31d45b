// SPDX-License-Identifier: Apache-2.0
// Takes the camera's own motion out of the picture: luma -> luma as the reference camera would have seen it.
//
// The reference is the frame that the background model started with, so model and reference never drift apart: every
// frame is aligned with that one picture, not with the frame before. From a small picture (shrink.h) the motion is
// estimated (align.h), then the luma is resampled (warp.h); what the frame no longer shows is filled with the background.
// Frames of reference: reference pixels -> frame pixels by `frame_from_reference`.
// Modes: `on` resamples every frame; `automatic` only looks until the camera moves, then does the same; a still
// camera's frames are handed through untouched. While nothing moves it looks at one frame in four.
// Memory: 1 byte a pixel, and about 0.1 MB; `off` takes none. Cost at 960x544: see docs/PERFORMANCE.md.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/image_view.h"
#include "core/base/limits.h"
#include "core/base/similarity.h"
#include "core/stabilise/align.h"

namespace nt {

enum class Stabilise : uint8_t { off, on, automatic };

struct Stabilised {
  LumaView luma;                    // the frame's own pixels where nothing was moved
  Similarity frame_from_reference;  // the identity where nothing was moved
  bool moved = false;               // luma was resampled
  bool lost = false;                // the view is not recognised: this frame's masks would mean nothing
  bool renewed = false;             // this frame is the new reference: the background must start anew with it
};

class Stabiliser {
 public:
  // Null for Stabilise::off.
  static Stabiliser* create(Arena& arena, Stabilise mode, int width, int height);
  Stabiliser() = default;

  // `background`: the model's estimate, reference pixels, for what the frame does not show; empty before there is one.
  Stabilised apply(LumaView luma, LumaView background);
  // The next frame is the reference: the background model starts anew with it.
  void restart() { has_reference_ = false; }

  bool active() const { return active_; }  // frames are resampled
  // The reference shows too little texture: the camera's motion cannot be seen, and frames are handed through.
  bool blind() const { return has_reference_ && align_->textured() < Align::kFewestBlocks; }

 private:
  void take_reference();
  void predict();
  Similarity to_frame(const Similarity& small) const;
  float corner_shift(const Similarity& t) const;
  Stabilised give_up(LumaView luma);

  Stabilise mode_ = Stabilise::off;
  int width_ = 0, height_ = 0, factor_ = 1;
  Align* align_ = nullptr;
  std::span<uint16_t> columns_, small_pixels_;
  ImageView<uint16_t> small_;
  std::span<uint8_t> pixels_;
  ImageView<uint8_t> warped_;
  Similarity now_, before_;  // small pixels, about the middle
  bool has_reference_ = false;
  bool active_ = false;
  int64_t looked_ = 0;      // frames since the reference
  int strange_frames_ = 0;  // in a row, that were not recognised
};

}  // namespace nt
