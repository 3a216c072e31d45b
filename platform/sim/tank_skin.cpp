// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_skin.h"

#include "core/base/det_math.h"
#include "core/base/image_view.h"
#include "platform/sim/tank_fish.h"

namespace nt::tank {
namespace {

constexpr float kCaudalAlpha = 0.55f;

float smooth(float t) {
  t = det::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

float spot(float ds, float dn, float radius) { return 1.0f - smooth(det::sqrt(ds * ds + dn * dn) / radius); }

float fraction(float v) { return v - static_cast<float>(static_cast<int>(v + 100.0f) - 100); }

// Rows of overlapping arcs, darker at each arc's rim.
float scales(float s, float n) {
  constexpr float kAlong = 0.022f, kAcross = 0.024f;
  const float row = (s + 1.0f) / kAlong;
  const bool odd = (static_cast<int>(row) & 1) != 0;
  const float across = fraction(n / kAcross + (odd ? 0.5f : 0.0f)) - 0.5f;
  return fraction(row) - 2.0f * across * across;
}

float body_tone(float s, float n) {
  const float half = det::max(body_half_width(s), 0.015f);
  const float q = n / half;  // -1 .. 1 across the body
  float tone = 1.06f - 0.20f * q * q;
  tone -=
      0.20f * (1.0f - smooth(det::abs(n) / 0.020f)) * smooth((s - 0.06f) / 0.10f) * (1.0f - smooth((s - 0.75f) / 0.1f));
  tone += 0.10f * scales(s, n) * smooth((s - 0.24f) / 0.05f) * (1.0f - smooth((s - 0.82f) / 0.05f));
  const float gill = det::abs(s - 0.20f + 1.5f * n * n / 0.085f);
  tone -= 0.14f * (1.0f - smooth(gill / 0.012f)) * smooth((det::abs(n) - 0.03f) / 0.02f);
  const float eye = spot(s - 0.075f, det::abs(n) - 0.048f, 0.021f);
  return tone * (1.0f - 0.80f * smooth(1.6f * eye));
}

float ray_pattern(float v) { return 0.5f * det::sin(det::kTwoPi * v); }

}  // namespace

std::vector<Skin> make_skin(const TankScene& scene) {
  std::vector<Skin> skin(static_cast<std::size_t>(kSkinS) * kSkinN);
  for (int j = 0; j < kSkinN; ++j)
    for (int i = 0; i < kSkinS; ++i) {
      const float s = kSkinS0 + (kSkinS1 - kSkinS0) * static_cast<float>(i) / (kSkinS - 1);
      const float n = kSkinHalfWidth * (2.0f * static_cast<float>(j) / (kSkinN - 1) - 1.0f);
      const float fin = smooth((s - 0.83f) / 0.07f);  // 0 on the body, 1 on the caudal fin
      const float ray = ray_pattern(5.0f * n / det::max(s - 0.78f, 0.03f));
      skin[static_cast<std::size_t>(j) * kSkinS + i] = {
          scene.body_luma * ((1.0f - fin) * body_tone(s, n) + fin * (0.97f + 0.10f * ray)),
          (1.0f - fin) + fin * (kCaudalAlpha + 0.18f * ray)};
    }
  return skin;
}

float fin_ray(Vec2 at, Vec2 tip) {
  const float along = dot(at, tip), across = cross(at, tip);
  const float slope = along > 0.0f ? across / along : 0.0f;  // rays are lines through the root
  const float v = 7.0f * slope;
  const float saw = v - static_cast<float>(static_cast<int>(v + 1000.0f) - 1000);
  return 4.0f * saw * (1.0f - saw) - 0.5f;
}

Tints::Tints(float cr_per_luma, float cb_per_luma) {
  for (int luma = 0; luma < 256; ++luma) {
    const float y = static_cast<float>(luma);
    float cr = cr_per_luma * y, cb = cb_per_luma * y;
    // Red may rise to 255 and blue fall to 0, no further.
    const float keep =
        det::min(1.0f, det::min((255.0f - y) / det::max(1.402f * cr, 1e-3f), y / det::max(-1.772f * cb, 1e-3f)));
    cr *= keep;
    cb *= keep;
    const float channels[3] = {1.402f * cr, -0.344136f * cb - 0.714136f * cr, 1.772f * cb};
    for (int c = 0; c < 3; ++c)
      offsets_[luma][c] = static_cast<int16_t>(channels[c] < 0 ? channels[c] - 0.5f : channels[c] + 0.5f);
  }
}

}  // namespace nt::tank
