// SPDX-License-Identifier: Apache-2.0
#include "core/segment/thin_tail.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr int kAhead = 12;                    // pixels of the line that are looked at together
constexpr float kBeside = 3.0f;               // from its middle to where the ground is taken
constexpr float kStep = 2.0f, kClear = 4.0f;  // pixels that are gone in a step, and that must be free before it
constexpr int kAngles = 4;                    // either side of straight on
constexpr float kAngle = 0.17f;               // between them, radians
constexpr float kSurely = 2.0f;               // noise sigmas of one pixel; of the mean along the line over five
constexpr float kLeast = 2.0f;                // grey levels
constexpr float kFades = 0.7f;                // of what stood out a step before; what ends at once fades faster
constexpr float kStraight = 1.0f;             // of that, straight on: no need to look elsewhere
constexpr float kKeepOn = 0.6f;               // of the direction's change is taken over in a step

class Ridge {
 public:
  Ridge(LumaView luma, LumaView ground) : luma_(luma), ground_(ground) {}

  // Mean of luma - ground along kAhead pixels from `from`, less the larger of its sides: how much it stands out.
  float contrast(Vec2 from, Vec2 direction, float sign) const {
    const Vec2 side = right_of(direction) * kBeside;
    float on = 0, left = 0, right = 0;
    for (int i = 1; i <= kAhead; ++i) {
      const Vec2 p = from + direction * static_cast<float>(i);
      if (!inside(p) || !inside(p + side) || !inside(p - side)) return 0.0f;
      on += at(p), left += at(p + side), right += at(p - side);
    }
    return (sign * on - det::max(det::max(sign * left, sign * right), 0.0f)) / kAhead;
  }

 private:
  bool inside(Vec2 p) const {
    return p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(luma_.width - 1) &&
           p.y < static_cast<float>(luma_.height - 1);
  }
  float at(Vec2 p) const {
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y);
    const auto d = [&](int i, int j) { return static_cast<float>(luma_.row(j)[i] - ground_.row(j)[i]); };
    const float above = d(x, y) + u * (d(x + 1, y) - d(x, y));
    const float below = d(x, y + 1) + u * (d(x + 1, y + 1) - d(x, y + 1));
    return above + v * (below - above);
  }

  LumaView luma_, ground_;
};

bool covers(const BitMask& mask, const Box& box, Vec2 p) {
  const int x = static_cast<int>(p.x) - box.x0, y = static_cast<int>(p.y) - box.y0;
  return x >= 0 && y >= 0 && x < mask.width && y < mask.height && mask.at(x, y);
}

void paint(Vec2 from, Vec2 to, const Box& box, const BitMask& mask) {
  const int n = static_cast<int>(length(to - from) * 2.0f) + 1;
  for (int i = 0; i <= n; ++i) {
    const Vec2 p = lerp(from, to, static_cast<float>(i) / static_cast<float>(n));
    const int x = static_cast<int>(p.x) - box.x0, y = static_cast<int>(p.y) - box.y0;
    for (int dy = 0; dy <= 1; ++dy)
      for (int dx = 0; dx <= 1; ++dx)
        if (x + dx >= 0 && y + dy >= 0 && x + dx < mask.width && y + dy < mask.height) mask.set(x + dx, y + dy);
  }
}

}  // namespace

float follow_thin_tail(LumaView luma, LumaView ground, float noise_sigma, const ThinTail& tail, const Box& box,
                       const BitMask& mask) {
  const Ridge ridge(luma, ground);
  Vec2 direction = tail.direction, here = tail.from;
  // Lighter or darker than the ground, as the end of the tail is that the outline has.
  const float light = ridge.contrast(here, direction, 1.0f), dark = ridge.contrast(here, direction, -1.0f);
  const float sign = light >= dark ? 1.0f : -1.0f;
  const float noise = det::max(kSurely * noise_sigma, kLeast);
  float before = det::max(light, dark), gone = 0;
  bool left = false;
  while (gone < tail.most_px) {
    Vec2 best_direction = direction;
    float best = ridge.contrast(here, direction, sign);
    for (int a = -kAngles; a <= kAngles && best < kStraight * before; ++a) {
      const det::SinCos turn = det::sincos(kAngle * static_cast<float>(a));
      const Vec2 d{direction.x * turn.cos - direction.y * turn.sin, direction.x * turn.sin + direction.y * turn.cos};
      const float c = ridge.contrast(here, d, sign);
      if (c > best) best = c, best_direction = d;
    }
    if (best < det::max(noise, kFades * before)) break;
    before = best;
    direction = normalised(lerp(direction, best_direction, kKeepOn));
    const Vec2 next = here + direction * kStep;
    // Out of the mask and in again: this is the fish's own head, or another fish.
    left |= !covers(mask, box, next);
    if (left && covers(mask, box, next + direction * kClear)) break;
    paint(here, next, box, mask);
    here = next, gone += kStep;
  }
  return gone;
}

}  // namespace nt
