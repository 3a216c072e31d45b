// SPDX-License-Identifier: Apache-2.0
// How the simulated fish looks: skin as a picture in body coordinates, fin rays, colour.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/det_math.h"
#include "core/base/vec2.h"
#include "platform/sim/tank_scenes.h"

namespace nt::tank {

inline constexpr int kSkinS = 768, kSkinN = 192;  // cells along and across
inline constexpr float kSkinS0 = -0.05f, kSkinS1 = 1.15f,
                       kSkinHalfWidth = 0.13f;  // the part of the plane they cover, BL

struct Skin {
  float luma, alpha;
};

// Luma and opacity of body and caudal fin: scales, a dark back stripe, eyes, gill covers, darker flanks, fin rays.
std::vector<Skin> make_skin(const TankScene& scene);

// Bilinear.
inline Skin skin_at(const std::vector<Skin>& skin, float s, float n) {
  const float u = det::clamp((s - kSkinS0) * ((kSkinS - 1) / (kSkinS1 - kSkinS0)), 0.0f, kSkinS - 1.01f);
  const float v = det::clamp((n + kSkinHalfWidth) * ((kSkinN - 1) / (2.0f * kSkinHalfWidth)), 0.0f, kSkinN - 1.01f);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
  const Skin* at = skin.data() + static_cast<std::size_t>(j) * kSkinS + i;
  const auto mix = [&](float Skin::*part) {
    const float top = at[0].*part + (at[1].*part - at[0].*part) * fu;
    const float bottom = at[kSkinS].*part + (at[kSkinS + 1].*part - at[kSkinS].*part) * fu;
    return top + (bottom - top) * fv;
  };
  return {mix(&Skin::luma), mix(&Skin::alpha)};
}

// How much a ray of a pectoral fin shows at `at`, both from the fin's root; -0.5 .. 0.5.
float fin_ray(Vec2 at, Vec2 tip);

// Offsets of r, g, b from a luma for one hue. Cr and Cb grow with the luma and shrink again where a channel would clip,
// so BT.601 luma of the colour stays the luma it was made from.
class Tints {
 public:
  Tints(float cr_per_luma, float cb_per_luma);
  int offset(uint8_t luma, int channel) const { return offsets_[luma][channel]; }

 private:
  std::array<std::array<int16_t, 3>, 256> offsets_;
};

}  // namespace nt::tank
