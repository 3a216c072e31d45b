// SPDX-License-Identifier: Apache-2.0
// How the simulated fish moves: a scene's row and a seed -> a Posture for every moment.
//
// Burst and coast, wandering turns, steering off the walls, C-starts, rests, leaving and coming back, holding station;
// each pectoral fin opens, folds and beats by a clock of its own. Time runs in steps of at most 1/120 s, so that a frame
// rate only samples the motion. Positions are frame pixels; speeds are body lengths a second. Cost: below 2 us a frame.
// Differs from hydrodynamics: speed, turning and bending follow first-order lags; the tail beat is shown, not its force.
#pragma once
#include "core/base/random.h"
#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_scenes.h"

namespace nt::tank {

class Swimmer {
 public:
  Swimmer(const TankScene& scene, uint64_t seed, int width, int height);
  void advance(double dt_s);
  Posture posture() const;

  // Towards or away from a point, as long as walls and rests let it; holds until it is set again.
  enum class Steer { free, towards, away };
  void steer(Steer how, Vec2 point);
  Vec2 pivot() const { return pivot_; }
  Vec2 direction() const;  // unit, of the body at the pivot
  Vec2 velocity_px_s() const;

 private:
  enum class Place { inside, leaving, away, coming };
  struct Fin {
    float target = 0, level = 0;  // 0 folded .. 1 open
    float until_change_s = 0;
    float phase_rad = 0, beat_hz = 0;
  };
  void step(float h);
  void change_place(float h);
  void change_gait(float h);
  void change_c_start(float h);
  float wanted_turn(float h);
  float turn_towards(Vec2 goal) const;
  bool in_room(Vec2 p) const;
  bool near_wall() const;  // it would soon leave its room
  void swim(float h);
  void hold_station(float h);
  void beat(float h);
  void move_fin(int side, float h);
  float around(float mean);  // a random duration, uniform in 0.5 .. 1.5 of the mean
  float symmetric();         // uniform in -1 .. 1

  TankScene scene_;
  Random random_;
  Vec2 size_;
  float length_px_;
  Vec2 room_lo_, room_hi_;  // where the pivot may be without steering away from a wall
  double pending_s_ = 0;

  Place place_ = Place::inside;
  float until_place_s_ = 0;
  Vec2 goal_;
  Steer steer_ = Steer::free;
  Vec2 steer_point_;
  Vec2 pivot_, velocity_;  // velocity is used by hold_station only
  float heading_ = 0, turn_rad_s_ = 0, wander_rad_s_ = 0, until_wander_s_ = 0;
  float speed_ = 0.3f;
  bool bursting_ = false;
  float until_gait_s_ = 0;
  bool resting_ = false;
  float until_rest_s_ = 0;
  float c_start_age_s_ = -1, until_c_start_s_ = 0, c_start_turn_rad_ = 0;
  Vec2 home_, station_;
  float station_heading_ = 0, station_turn_ = 0;
  float bend_ = 0, wave_ = 0.1f, wave_phase_ = 0;
  Fin fins_[2];
};

}  // namespace nt::tank
