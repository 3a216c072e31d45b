// SPDX-License-Identifier: Apache-2.0
// A character swims without a camera: on the spot, after the fish of the simulated tank.
//
// Input: a character, the time, where and how large. Output: vertices and control points in scene pixels.
// The motion is the tank's own truth (platform/sim/tank.h, scene `turns`): bends, C-starts, fins that open and fold. It is
// made as it is played and goes on for ever. The centre stays in its place; the heading is the fish's.
// Cost: a tank frame of 160x90 pixels 30 times a second; putting on a character is Retarget::create.
#pragma once
#include <span>

#include "app/aligned_block.h"
#include "core/character/retarget.h"
#include "platform/sim/tank.h"

namespace nt {

class TestSwim {
 public:
  TestSwim();
  // Throws UserError where the character cannot swim. Its vertices and triangles must outlive the next wear().
  void wear(const Character& character);
  // dt_s after the last call; `length_px` is the character's from head to tail.
  void step(float dt_s, Vec2 centre, float length_px);

  std::span<const Vec2> vertices() const { return retarget_->vertices(); }
  const ControlPoints& control_points() const { return retarget_->control_points(); }

 private:
  void next_motion();

  Tank tank_;
  Motion previous_, current_;
  float since_s_ = 0;  // the last motion
  AlignedBlock memory_;
  Retarget* retarget_ = nullptr;  // lives in memory_
};

}  // namespace nt
