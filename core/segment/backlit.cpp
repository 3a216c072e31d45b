// SPDX-License-Identifier: Apache-2.0
#include "core/segment/backlit.h"

#include "core/segment/difference.h"
#include "core/segment/field.h"
#include "core/segment/noise.h"

namespace nt {

Backlit* Backlit::create(Arena& arena, const BackgroundSettings& settings, int width, int height) {
  const std::size_t stride = align_up(static_cast<std::size_t>(width));
  auto self = arena.take<Backlit>(1);
  auto plane = arena.take_raw<uint8_t>(stride * static_cast<std::size_t>(height));
  if (self.empty() || plane.empty()) return nullptr;
  Backlit& backlit = self[0];
  backlit.settings_ = settings;
  backlit.width_ = width, backlit.height_ = height, backlit.stride_ = static_cast<std::ptrdiff_t>(stride);
  backlit.plane_ = plane;
  return &backlit;
}

void Backlit::fit(LumaView luma) {
  const FieldSurface surface = fit_field(luma);
  for (int y = 0; y < height_; ++y) surface.draw(0, y, width_, plane_.data() + y * stride_);
  const FieldResiduals found = measure_field(luma, surface);
  sigma_ = found.sigma;
  polarity_ = found.median_level > 127 ? -1 : 1;
  int inside = 0;
  for (int v = 0; v <= weak_threshold(sigma_); ++v) inside += found.residuals[static_cast<std::size_t>(v)];
  smooth_share_ = static_cast<float>(inside) / static_cast<float>(found.total);
}

bool Backlit::apply(LumaView luma, const BitMask* keep, const BitMask& foreground) {
  if (!started_) {
    fit(luma);
    light_.start(luma);
    started_ = true;
  }
  const ImageView<uint8_t> plane{plane_.data(), width_, height_, stride_};
  const Relight relight = light_.update(luma, keep != nullptr);
  relit_ = relight.all != 1.0f;
  if (relit_) scale_pixels(relight.all, plane_);
  if (relight.kept != 1.0f && keep != nullptr) scale_pixels(relight.kept, relight.rounding, *keep, plane);
  const int strong = settings_.radius > 0 ? settings_.radius : clamp_int(5 * weak_threshold(sigma_) / 2, 20, 90);
  mask_of_difference(luma, estimate(), strong, polarity_, foreground);
  follow_background(luma, foreground, keep, follow_limits(frames_++, weak_threshold(sigma_)), plane);
  return true;
}

void Backlit::absorb(LumaView luma, std::span<const Run> runs, int label) {
  copy_runs(luma, runs, label, {plane_.data(), width_, height_, stride_});
}

}  // namespace nt
