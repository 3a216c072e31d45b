// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/stabiliser.h"

#include "core/stabilise/shrink.h"
#include "core/stabilise/warp.h"

namespace nt {
namespace {

// A frame is recognised when half of the blocks agree; a fish that fills half the frame still leaves that.
constexpr float kLeastAgreeing = 0.5f;
constexpr float kLeastSeen = 0.55f;  // of the reference: with less in view it is time for a new one
constexpr int kPatience = 3;         // frames that may be strange (blurred by a jolt) before a new reference is taken
// The camera moves when a corner has moved by this, frame pixels, and moving it back explains most of the change. Less
// is nothing that a background model minds.
constexpr float kMoves_px = 0.6f;
constexpr float kExplained = 0.6f;
// A camera that has stood still for so many frames is looked at in every kSeldom-th one.
constexpr int64_t kSettled = 60, kSeldom = 4;
constexpr float kPrecise = 0.004f;  // small pixels

}  // namespace

Stabiliser* Stabiliser::create(Arena& arena, Stabilise mode, int width, int height) {
  if (mode == Stabilise::off) return nullptr;
  const int factor = shrink_factor(width);
  const int across = width / factor, down = height / factor;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(align_up(static_cast<std::size_t>(width)));
  auto self = arena.take<Stabiliser>(1);
  auto columns = arena.take<uint16_t>(static_cast<std::size_t>(width));
  auto small = arena.take<uint16_t>(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  auto pixels = arena.take<uint8_t>(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height));
  Align* align = Align::create(arena, across, down);
  if (self.empty() || align == nullptr) return nullptr;
  Stabiliser& s = self[0];
  s.mode_ = mode;
  s.width_ = width, s.height_ = height, s.factor_ = factor;
  s.align_ = align;
  s.columns_ = columns, s.small_pixels_ = small, s.pixels_ = pixels;
  s.small_ = {small.data(), across, down, across};
  s.warped_ = {pixels.data(), width, height, stride};
  s.active_ = mode == Stabilise::on;
  return &s;
}

// Small pixels about the middle -> frame pixels. A small pixel's centre is at factor i + (factor - 1) / 2, so the small
// picture's middle is the middle of the part of the frame that it covers.
Similarity Stabiliser::to_frame(const Similarity& small) const {
  const double cx = 0.5 * (small_.width * factor_ - 1), cy = 0.5 * (small_.height * factor_ - 1);
  Similarity t{small.a, small.b, 0, 0};
  t.x = cx - (t.a * cx - t.b * cy) + small.x * factor_;
  t.y = cy - (t.b * cx + t.a * cy) + small.y * factor_;
  return t;
}

float Stabiliser::corner_shift(const Similarity& t) const {
  const auto right = static_cast<float>(width_ - 1), bottom = static_cast<float>(height_ - 1);
  float most = 0;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{right, 0}, Vec2{0, bottom}, Vec2{right, bottom}}) {
    const float shift = length(t(p) - p);
    most = shift > most ? shift : most;
  }
  return most;
}

void Stabiliser::take_reference() {
  align_->set_reference({small_.data, small_.width, small_.height, small_.stride});
  now_ = before_ = {};
  strange_frames_ = 0;
  looked_ = 0;
  has_reference_ = true;
}

// The hand goes on as it went.
void Stabiliser::predict() {
  const Similarity next{2 * now_.a - before_.a, 2 * now_.b - before_.b, 2 * now_.x - before_.x, 2 * now_.y - before_.y};
  before_ = now_;
  now_ = next;
}

Stabilised Stabiliser::give_up(LumaView luma) {
  Stabilised out{luma, {}, false, true, false};
  now_ = before_;  // look again where it was seen last
  if (++strange_frames_ < kPatience) return out;
  take_reference();
  out.renewed = true;
  return out;
}

Stabilised Stabiliser::apply(LumaView luma, LumaView background) {
  Stabilised out;
  out.luma = luma;
  if (has_reference_ && !active_ && ++looked_ > kSettled && looked_ % kSeldom != 0) return out;
  shrink(luma, factor_, columns_, small_);
  if (!has_reference_) take_reference();
  if (blind()) return out;
  const Similarity last = now_;
  if (active_) predict();
  else now_ = before_ = {};
  const float close_enough = active_ ? kPrecise : 0.5f * kMoves_px / static_cast<float>(factor_);
  const SmallView picture{small_.data, small_.width, small_.height, small_.stride};
  Alignment found = align_->find(picture, now_, close_enough);
  const auto recognises = [](const Alignment& a) { return a.known && a.agreeing >= kLeastAgreeing; };
  if (active_ && !recognises(found)) found = align_->find(picture, align_->search(picture, last), close_enough);
  const bool recognised = recognises(found);
  const Similarity t = to_frame(found.seen_from_reference);
  if (!active_) {
    active_ = recognised && corner_shift(t) > kMoves_px && found.left < kExplained;
    if (!active_) return out;
    before_ = found.seen_from_reference;
  }
  if (!recognised || !can_warp(t)) {
    before_ = last;
    return give_up(luma);
  }
  strange_frames_ = 0;
  now_ = found.seen_from_reference;
  const float seen = warp_luma(luma, t, background.empty() ? luma : background, warped_);
  if (seen < kLeastSeen) {
    take_reference();
    out.lost = out.renewed = true;
    return out;
  }
  out.luma = {warped_.data, warped_.width, warped_.height, warped_.stride};
  out.frame_from_reference = t;
  out.moved = true;
  return out;
}

}  // namespace nt
