// SPDX-License-Identifier: Apache-2.0
#include "core/segment/still.h"

#include <cstring>

#include "core/segment/difference.h"
#include "core/segment/fill.h"

namespace nt {
namespace {

uint8_t median_of(uint8_t* values, int count) {
  for (int i = 1; i < count; ++i) {  // insertion sort: at most 20 values, off the frame path
    const uint8_t v = values[i];
    int j = i;
    for (; j > 0 && values[j - 1] > v; --j) values[j] = values[j - 1];
    values[j] = v;
  }
  return values[count / 2];
}

}  // namespace

Still* Still::create(Arena& arena, const BackgroundSettings& settings, int width, int height) {
  const std::size_t stride = align_up(static_cast<std::size_t>(width));
  const std::size_t plane = stride * static_cast<std::size_t>(height);
  auto self = arena.take<Still>(1);
  auto learned = arena.take_raw<uint8_t>(plane * kLearnFrames);
  auto background = arena.take_raw<uint8_t>(plane);
  if (self.empty() || background.empty()) return nullptr;
  Still& still = self[0];
  still.settings_ = settings;
  still.width_ = width, still.height_ = height, still.stride_ = static_cast<std::ptrdiff_t>(stride);
  still.learned_ = learned;
  still.plane_ = background;
  return &still;
}

void Still::learn(LumaView luma) {
  if (learned_count_ >= kLearnFrames || luma.width != width_ || luma.height != height_) return;
  noise_.add(luma);
  uint8_t* to = learned_.data() + learned_count_ * stride_ * height_;
  for (int y = 0; y < height_; ++y) std::memcpy(to + y * stride_, luma.row(y), static_cast<std::size_t>(width_));
  ++learned_count_;
}

void Still::restart() {
  started_ = false;
  learned_count_ = 0;
  noise_.restart();
}

void Still::take_median() {
  uint8_t values[kLearnFrames];
  const std::ptrdiff_t plane = stride_ * height_;
  for (std::ptrdiff_t i = 0; i < plane; ++i) {
    for (int k = 0; k < learned_count_; ++k) values[k] = learned_[static_cast<std::size_t>(k * plane + i)];
    plane_[static_cast<std::size_t>(i)] = median_of(values, learned_count_);
  }
}

bool Still::apply(LumaView luma, const BitMask* keep, const BitMask& foreground) {
  bool means_something = true;
  const ImageView<uint8_t> plane{plane_.data(), width_, height_, stride_};
  if (!started_) {
    means_something = learned_count_ > 0;
    if (learned_count_ == 0) learn(luma);
    take_median();
    started_ = true;
    light_.start(estimate());
    if (keep != nullptr && !means_something) {
      Random unused;
      fill_unknown(*keep, Fill::mean, unused, plane);
    }
    noise_.restart();  // the learned pictures may lie seconds apart; consecutive frames give the noise
  }
  noise_.add(luma);
  const Relight relight = light_.update(luma, keep != nullptr);
  relit_ = relight.all != 1.0f;
  if (relit_) scale_pixels(relight.all, plane_);
  if (relight.kept != 1.0f && keep != nullptr) scale_pixels(relight.kept, relight.rounding, *keep, plane);
  const int radius =
      settings_.radius > 0 ? settings_.radius : max_int(match_radius(noise_.sigma()), weak_threshold(noise_.sigma()));
  mask_of_difference(luma, estimate(), radius, 0, foreground);
  follow_background(luma, foreground, keep, follow_limits(frames_++, weak_threshold(noise_.sigma())), plane);
  return means_something;
}

void Still::absorb(LumaView luma, std::span<const Run> runs, int label) {
  copy_runs(luma, runs, label, {plane_.data(), width_, height_, stride_});
}

}  // namespace nt
