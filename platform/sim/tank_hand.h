// SPDX-License-Identifier: Apache-2.0
// A phone held in the hand: how the picture shifts, turns and scales over time.
//
// Time in seconds -> the similarity that takes the tank's pixels to the frame's; smooth, bounded, a function of the time
// alone: each channel is a sum of three slow sines whose amplitudes add up to the scene's. The fish is moved as a shape
// and drawn where it is seen; only the gravel is resampled (bilinear, 1 ms at 960x544).
#pragma once
#include <cstdint>

#include "core/base/vec2.h"
#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_scenes.h"

namespace nt::tank {

// p -> centre + m (p - centre) + shift, m = scale times rotation.
struct Similarity {
  Vec2 centre, shift;
  float cos = 1.0f, sin = 0.0f;  // times the scale
  float scale = 1.0f;

  Vec2 turned(Vec2 v) const { return {cos * v.x - sin * v.y, sin * v.x + cos * v.y}; }
  Vec2 operator()(Vec2 p) const { return centre + turned(p - centre) + shift; }
  Similarity inverse() const;
};

class Hand {
 public:
  Hand(const TankScene& scene, uint64_t seed, int width, int height);
  bool still() const { return still_; }
  Similarity frame_from_tank(double t_s) const;
  // How far beyond the frame's edges the tank is ever seen.
  static int margin_px(const TankScene& scene, int width, int height);

 private:
  static constexpr int kChannels = 4, kSines = 3;
  struct Sine {
    double hz, phase_turns;
    float share;
  };
  TankScene scene_;
  Vec2 size_;
  bool still_;
  Sine sines_[kChannels][kSines];
};

// The whole shape as the moved camera sees it.
void move_shape(const Similarity& to, FishShape& shape);

}  // namespace nt::tank
