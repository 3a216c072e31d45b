// SPDX-License-Identifier: Apache-2.0
#include "core/base/det_math.h"
#include "core/base/image_view.h"
#include "platform/sim/tank_raster.h"
#include "platform/sim/tank_water.h"

namespace nt::tank {
namespace {

constexpr float kMargin = 24.0f;  // px at 960: drifters come from and go to this far outside the frame

float smooth(float t) {
  t = det::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// v modulo span, in [0, span); in double, so that hours of drifting keep their pixels.
double wrapped(double v, double span) {
  const double turns = v / span;
  const double rest = turns - static_cast<double>(static_cast<int64_t>(turns));
  return (rest < 0 ? rest + 1 : rest) * span;
}

struct Paint {
  float luma, alpha;
};

// q: position in the bubble, in its radii. A bright rim, a clear middle, the lamp's image.
Paint bubble_at(Vec2 q) {
  const float r = length(q);
  const float rim = smooth((r - 0.55f) / 0.3f) * (1.0f - smooth((r - 0.85f) / 0.15f));
  const float glint = 1.0f - smooth(length(q - Vec2{-0.35f, -0.38f}) / 0.32f);
  return {200.0f + 55.0f * glint, det::max(0.55f * rim, 0.9f * glint)};
}

}  // namespace

Drifters::Drifters(const TankScene& scene, uint64_t seed, int width, int height)
    : size_{static_cast<float>(width), static_cast<float>(height)}, unit_px_(static_cast<float>(width) / 960.0f) {
  Random random(seed ^ 0x44495254ull);
  const auto between = [&](float lo, float hi) { return lo + (hi - lo) * random.unit(); };
  for (int i = 0; i < scene.bubbles + scene.particles; ++i) {
    Drifter d;
    d.bubble = i < scene.bubbles;
    d.start.x = random.unit() * (size_.x + 2 * kMargin * unit_px_);
    d.start.y = random.unit() * (size_.y + 2 * kMargin * unit_px_);
    d.radius_px = (d.bubble ? between(4.0f, 11.0f) : between(1.2f, 4.0f)) * unit_px_;
    d.speed_px_s.x = between(-6.0f, d.bubble ? 6.0f : 22.0f) * unit_px_;
    d.speed_px_s.y = (d.bubble ? -between(50.0f, 130.0f) : between(-8.0f, 12.0f)) * unit_px_;
    d.sway_px = between(2.0f, 9.0f) * unit_px_;
    d.sway_rad_s = d.bubble ? between(3.0f, 6.0f) : between(0.3f, 0.9f);
    d.phase_rad = random.unit() * det::kTwoPi;
    d.luma = random.below(3) == 0 ? between(20.0f, 50.0f) : between(150.0f, 215.0f);
    drifters_.push_back(d);
  }
}

void Drifters::draw(double t_s, Canvas& canvas) const {
  for (const Drifter& drifter : drifters_) draw_one(drifter, t_s, canvas);
}

void Drifters::draw_one(const Drifter& d, double t_s, Canvas& canvas) const {
  const float margin = kMargin * unit_px_;
  const auto along = [&](float start, float speed, float size) {
    return static_cast<float>(wrapped(start + t_s * static_cast<double>(speed), size + 2 * margin)) - margin;
  };
  const auto turn = static_cast<float>(wrapped(t_s * static_cast<double>(d.sway_rad_s), det::kTwoPi));
  Vec2 at{along(d.start.x, d.speed_px_s.x, size_.x), along(d.start.y, d.speed_px_s.y, size_.y)};
  at.x += d.sway_px * det::sin(turn + d.phase_rad);
  // A bubble nears the camera while it rises.
  const float radius = d.radius_px * (d.bubble ? 1.25f - 0.5f * at.y / size_.y : 1.0f);
  const Vec2 reach{radius, radius};
  const Vec2 corners[2] = {at - reach, at + reach};
  const Box box = box_of(corners, 0);
  for (int y = max_int(box.y0, 0); y < min_int(box.y1, canvas.height); ++y)
    for (int x = max_int(box.x0, 0); x < min_int(box.x1, canvas.width); ++x) {
      const Vec2 q = (Vec2{static_cast<float>(x), static_cast<float>(y)} - at) * (1.0f / radius);
      const Paint paint = d.bubble ? bubble_at(q) : Paint{d.luma, 0.8f * (1.0f - smooth(length(q)))};
      if (paint.alpha <= 0) continue;
      int16_t& light = canvas.row(y)[x];
      const float seen = static_cast<float>(light);
      light = static_cast<int16_t>(seen + paint.alpha * (16.0f * paint.luma - seen) + 0.5f);
    }
}

}  // namespace nt::tank
