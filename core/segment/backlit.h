// SPDX-License-Identifier: Apache-2.0
// A bright or dark even field as a background model: luma -> foreground mask from the first frame on.
//
// For fish that hold their place and never uncover what lies behind them (a flume, a resting fish): no temporal model can
// learn that, but an evenly lit field is smooth, so a quadratic surface fitted to it tells what the fish hides.
// Method: the robust surface of field.h. The polarity (dark fish on a bright field or the other way round)
// follows the field's median. Outside the fish the plane then follows what is seen, by sigma-delta steps, so dirt and
// shading fade into it.
// Memory: 1 byte a pixel. Cost: the fit about 3 ms, once; then two passes over the rows a frame.
#pragma once
#include <cstdint>
#include <span>

#include "core/segment/background.h"
#include "core/segment/light.h"

namespace nt {

class Backlit final : public Background {
 public:
  static Backlit* create(Arena& arena, const BackgroundSettings& settings, int width, int height);
  Backlit() = default;

  const char* name() const override { return "backlit"; }
  void learn(LumaView) override {}
  void restart() override { started_ = false; }
  bool ready() const override { return true; }
  bool apply(LumaView luma, const BitMask* keep, const BitMask& foreground) override;
  void absorb(LumaView luma, std::span<const Run> runs, int label) override;
  LumaView estimate() const override { return {plane_.data(), width_, height_, stride_}; }
  float noise_sigma() const override { return sigma_; }
  bool relit() const override { return relit_; }
  bool can_have_shadows() const override { return false; }

  // How well the field is described: share of a pixel grid within the weak threshold of the surface, after the first frame.
  float smooth_share() const { return smooth_share_; }
  int polarity() const { return polarity_; }  // +1 bright fish, -1 dark fish

 private:
  void fit(LumaView luma);

  BackgroundSettings settings_;
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::span<uint8_t> plane_;
  float sigma_ = 2.5f;  // roughness of the field, noise included
  int polarity_ = -1;
  float smooth_share_ = 0;
  Light light_;
  bool started_ = false;
  bool relit_ = false;
  uint32_t frames_ = 0;
};

}  // namespace nt
