// SPDX-License-Identifier: Apache-2.0
// ViBe, the background model of [F] section 4: luma -> foreground mask.
//
// Source: Barnich and Van Droogenbroeck, "ViBe: a universal background subtraction algorithm for video sequences", IEEE
// TIP 2011: N = 20 samples a pixel, #min = 2 matches within R, one in phi = 16 background pixels refreshes one of its own
// samples and one of a random neighbour's.
// Differs: the samples are 20 planes of rows, so that a background pixel touches two of them and not 20 bytes; the random
// choice of the sample is made per row (so memory is walked in streams), of the neighbour per row and 64-pixel segment; one
// segment in four has its turn, and in it one pixel in four, from a seeded table. The first two planes hold only a pixel's own past values, never a neighbour's: they
// nearly always match, so most pixels need no third plane. Otherwise every pixel's chances are those of the paper. R follows the noise (20 at an ordinary camera's).
// Memory: 21 bytes a pixel and the table. Cost at 960x544: see docs/PERFORMANCE.md.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/random.h"
#include "core/segment/background.h"
#include "core/segment/light.h"
#include "core/segment/noise.h"

namespace nt {

class Vibe final : public Background {
 public:
  static constexpr int kSamples = 20;
  static constexpr int kMinMatches = 2;
  static constexpr int kSubsampling = 16;
  static constexpr int kSegments = 4;  // one 64-pixel segment in this many has its turn in a frame
  // One frame says little of a surface that moves: at first each frame is learned as if it were several. Only by its own
  // pixel: learned from its neighbours as well, what is beside a thin tail would soon know the tail.
  static constexpr int kEagerFrames = 60, kEagerRounds = 4;
  static constexpr int kGuessFrames = 20;  // a beat of the tail

  static Vibe* create(Arena& arena, const BackgroundSettings& settings, int width, int height, uint64_t seed);
  Vibe() = default;

  const char* name() const override { return "vibe"; }
  void learn(LumaView luma) override;
  void restart() override;
  bool ready() const override { return started_; }
  bool apply(LumaView luma, const BitMask* keep, const BitMask& foreground) override;
  void absorb(LumaView luma, std::span<const Run> runs, int label) override;
  LumaView estimate() const override { return {plane_.data(), width_, height_, stride_}; }
  float noise_sigma() const override { return noise_.sigma(); }
  bool relit() const override { return relit_; }
  void clear_familiar(LumaView part, int x0, int y0, int threshold, const BitMask& differing) const override;
  bool can_have_shadows() const override { return true; }

  int radius() const;

 private:
  void initialise(LumaView luma, const BitMask* unknown);
  void guess(const BitMask& unknown);
  void settle_guess(LumaView luma);
  void follow_light(LumaView luma, const BitMask* keep);
  // What a row's refresh draws: where it writes, and a bit for each segment that has its turn.
  struct Turn {
    const uint8_t *own_choice, *neighbour_choice;
    uint8_t *own, *other;
    uint64_t own_segments, neighbour_segments, shifts;
  };
  Turn draw_turn(int y, bool neighbours);
  void refresh_row(LumaView luma, int y, const Turn& turn, const uint64_t* foreground, const uint64_t* keep);
  uint8_t* sample_row(int k, int y) const {
    return samples_.data() + (static_cast<std::ptrdiff_t>(k) * height_ + y) * stride_;
  }
  ImageView<uint8_t> sample_plane(int k) const { return {sample_row(k, 0), width_, height_, stride_}; }

  BackgroundSettings settings_;
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::span<uint8_t> samples_;  // kSamples planes
  std::span<uint8_t> plane_;    // sigma-delta estimate of the background
  std::span<uint8_t> chosen_;   // random table: 255 with probability kSegments / kSubsampling, else 0
  BitMask guessed_;             // hidden by a fish when the model was learned, as far as is known
  int guess_age_ = kGuessFrames;
  Random random_;
  NoiseMeter noise_;
  Light light_;
  bool started_ = false;
  bool relit_ = false;
  uint32_t frames_ = 0;
};

}  // namespace nt
