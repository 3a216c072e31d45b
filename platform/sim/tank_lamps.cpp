// SPDX-License-Identifier: Apache-2.0
#include "core/base/det_math.h"
#include "platform/sim/tank_water.h"

namespace nt::tank {
namespace {

constexpr double kFlickerHz = 100.0;      // light of a lamp on 50 Hz mains
constexpr double kReadOutS = 1.0 / 60.0;  // from the first row to the last
constexpr double kDriftS = 23.0;          // period of the slow drift
constexpr int kOne = 1 << 12;

// sin of that many turns; doubles keep the phase over hours.
float turn_sin(double turns) {
  return det::sin(det::kTwoPi * static_cast<float>(turns - static_cast<double>(static_cast<int64_t>(turns))));
}

}  // namespace

Lamps::Lamps(const TankScene& scene)
    : scene_(scene), steady_(scene.lamp_on_s <= 0 && scene.light_drift <= 0 && scene.flicker <= 0) {}

float Lamps::at(double t_s, float row_share) const {
  const float lamp = t_s < static_cast<double>(scene_.lamp_on_s) ? scene_.light_before_lamp : 1.0f;
  const float drift = 1.0f + scene_.light_drift * turn_sin(t_s / kDriftS);
  const float flicker =
      1.0f + scene_.flicker * turn_sin(kFlickerHz * (t_s + kReadOutS * static_cast<double>(row_share)));
  return lamp * drift * flicker;
}

void Lamps::apply(double t_s, Canvas& canvas) const {
  if (steady_) return;
  for (int y = 0; y < canvas.height; ++y) {
    const float share = static_cast<float>(y) / static_cast<float>(canvas.height);
    const int factor = static_cast<int>(at(t_s, share) * kOne + 0.5f);
    int16_t* light = canvas.row(y);
    for (int x = 0; x < canvas.stride; ++x) light[x] = static_cast<int16_t>((light[x] * factor + kOne / 2) >> 12);
  }
}

}  // namespace nt::tank
