// SPDX-License-Identifier: Apache-2.0
// All the fish of a scene: the one whose truth is asked for, and its companions.
//
// Scene + seed + size -> a shape for every fish at every moment, tank pixels, the target first. Companions are smaller,
// come in later and keep away from the target, but for the first of them, which from time to time swims over it.
// The target does not heed them. Cost: about 25 us a fish and frame.
#pragma once
#include <span>
#include <vector>

#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_swim.h"

namespace nt::tank {

class School {
 public:
  School(const TankScene& scene, uint64_t seed, int width, int height);
  void advance(double dt_s);
  void shape(std::vector<FishShape>& out) const;

 private:
  bool amid(Vec2 p) const;
  void steer_companion(std::size_t i, double dt_s);
  struct Fish {
    Swimmer swimmer;
    FishModel model;
    float length_px;
  };
  std::vector<Fish> fish_;  // the target first
  Vec2 size_;
  double cross_every_s_;
  double until_cross_s_;
};

// Whether the other fish lies over a part of this one.
bool overlap(const FishShape& fish, const FishShape& other);

}  // namespace nt::tank
