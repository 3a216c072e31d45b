// SPDX-License-Identifier: Apache-2.0
// The empty tank as a background model: luma -> foreground mask. Unpatented, one background plane.
//
// The plane is the median of up to kLearnFrames pictures (one is enough: an empty-tank picture), or the first frame when
// there was nothing to learn from. It then follows slow light by sigma-delta steps outside the fish (difference.h).
// Memory: 21 bytes a pixel (20 only while it learns). Cost: two passes over the rows.
#pragma once
#include <cstdint>
#include <span>

#include "core/segment/background.h"
#include "core/segment/light.h"
#include "core/segment/noise.h"

namespace nt {

class Still final : public Background {
 public:
  static Still* create(Arena& arena, const BackgroundSettings& settings, int width, int height);
  Still() = default;

  const char* name() const override { return "still"; }
  void learn(LumaView luma) override;
  void restart() override;
  bool ready() const override { return started_ || learned_count_ > 0; }
  bool apply(LumaView luma, const BitMask* keep, const BitMask& foreground) override;
  void absorb(LumaView luma, std::span<const Run> runs, int label) override;
  LumaView estimate() const override { return {plane_.data(), width_, height_, stride_}; }
  float noise_sigma() const override { return noise_.sigma(); }
  bool relit() const override { return relit_; }
  bool can_have_shadows() const override { return true; }

 private:
  void take_median();

  BackgroundSettings settings_;
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::span<uint8_t> learned_;  // kLearnFrames planes
  std::span<uint8_t> plane_;
  int learned_count_ = 0;
  Light light_;
  bool started_ = false;
  bool relit_ = false;
  uint32_t frames_ = 0;
  NoiseMeter noise_;
};

}  // namespace nt
