// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_hand.h"

#include "core/base/det_math.h"
#include "core/base/random.h"

namespace nt::tank {

Similarity Similarity::inverse() const {
  // p = centre + m^-1 (q - centre - shift) = centre + m^-1 (q - centre) - m^-1 shift
  Similarity back;
  const float per_scale_sq = 1.0f / (cos * cos + sin * sin);
  back.centre = centre;
  back.cos = cos * per_scale_sq;
  back.sin = -sin * per_scale_sq;
  back.scale = 1.0f / scale;
  back.shift = back.turned(shift) * -1.0f;
  return back;
}

Hand::Hand(const TankScene& scene, uint64_t seed, int width, int height)
    : scene_(scene),
      size_{static_cast<float>(width), static_cast<float>(height)},
      still_(scene.shake_shift <= 0 && scene.shake_rad <= 0 && scene.shake_scale <= 0) {
  // Slow sway of the arm, the hand's own movement, a little tremor.
  constexpr Sine kSway[kSines] = {{0.19, 0, 0.60f}, {0.63, 0, 0.32f}, {1.9, 0, 0.08f}};
  Random random(seed ^ 0x48414e44ull);
  for (auto& channel : sines_)
    for (int i = 0; i < kSines; ++i) {
      const double faster = static_cast<double>(random.unit());
      channel[i] = {kSway[i].hz * (0.8 + 0.4 * faster), static_cast<double>(random.unit()), kSway[i].share};
    }
}

Similarity Hand::frame_from_tank(double t_s) const {
  Similarity out;
  out.centre = (size_ - Vec2{1.0f, 1.0f}) * 0.5f;
  if (still_) return out;
  float level[kChannels] = {};
  for (int c = 0; c < kChannels; ++c)
    for (const Sine& sine : sines_[c]) {
      const double turns = t_s * sine.hz + sine.phase_turns;
      const double part = turns - static_cast<double>(static_cast<int64_t>(turns));
      level[c] += sine.share * det::sin(det::kTwoPi * static_cast<float>(part));
    }
  out.shift = Vec2{level[0], level[1]} * (scene_.shake_shift * size_.x);
  out.scale = 1.0f + scene_.shake_scale * level[3];
  const det::SinCos turn = det::sincos(scene_.shake_rad * level[2]);
  out.cos = out.scale * turn.cos;
  out.sin = out.scale * turn.sin;
  return out;
}

int Hand::margin_px(const TankScene& scene, int width, int height) {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const float half_diagonal = 0.5f * det::sqrt(w * w + h * h);
  const float move = scene.shake_shift * w + half_diagonal * (scene.shake_rad + scene.shake_scale);
  return move > 0 ? static_cast<int>(move / (1.0f - scene.shake_scale)) + 2 : 0;
}

void move_shape(const Similarity& to, FishShape& shape) {
  const auto move = [&](std::vector<Vec2>& points) {
    for (Vec2& p : points) p = to(p);
  };
  shape.length_px *= to.scale;
  move(shape.spine);
  for (Vec2& n : shape.normal) n = to.turned(n) * (1.0f / to.scale);
  move(shape.body);
  move(shape.contour);
  for (FinShape& fin : shape.fin) {
    move(fin.polygon);
    move(fin.outside);
    for (Vec2* p : {&fin.tip, &fin.front, &fin.rear, &fin.root}) *p = to(*p);
  }
}

}  // namespace nt::tank
