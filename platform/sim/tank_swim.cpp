// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_swim.h"

#include "core/base/det_math.h"

namespace nt::tank {
namespace {

constexpr float kStepS = 1.0f / 120.0f;
constexpr float kWallRoom = 0.72f;      // BL between the pivot and a wall before the fish steers away
constexpr float kWallTurn = 2.2f;       // rad/s, the hardest it steers
constexpr float kWallSpeed = 0.4f;      // BL/s, to which it brakes there
constexpr float kPassingSpeed = 0.08f;  // BL/s, of a fish that lets another swim off
constexpr float kOutside = 1.15f;       // BL past the edge at which nothing of the fish is seen
constexpr float kStationSpeed = 0.6f;   // BL/s, the fastest it drifts

// Moves a value towards its target with the time constant tau.
void follow(float& value, float target, float h, float tau) { value += (target - value) * det::min(h / tau, 1.0f); }

Vec2 unit(float angle) {
  const det::SinCos d = det::sincos(angle);
  return {d.cos, d.sin};
}

}  // namespace

Swimmer::Swimmer(const TankScene& scene, uint64_t seed, int width, int height)
    : scene_(scene),
      random_(seed ^ 0x5357494dull),
      size_{static_cast<float>(width), static_cast<float>(height)},
      length_px_(scene.body_length * static_cast<float>(width)) {
  const Vec2 inset{det::min(kWallRoom * length_px_, 0.45f * size_.x),
                   det::min(kWallRoom * length_px_, 0.45f * size_.y)};
  room_lo_ = inset;
  room_hi_ = size_ - inset;
  pivot_ = size_ * 0.5f + Vec2{symmetric() * 0.05f * size_.x, symmetric() * 0.1f * size_.y};
  const bool from_left = random_.below(2) == 0;
  heading_ = from_left ? 0.0f : det::kPi;
  home_ = scene_.enters ? size_ * 0.5f : pivot_;
  station_ = home_;
  station_heading_ = heading_;
  until_rest_s_ = scene_.hover_every_s;
  until_c_start_s_ = around(scene_.c_start_every_s);
  until_place_s_ = scene_.leave_every_s;
  if (scene_.enters) {
    pivot_.x = from_left ? -kOutside * length_px_ : size_.x + kOutside * length_px_;
    place_ = Place::away;
    until_place_s_ = scene_.wait_s;
  }
  for (Fin& fin : fins_) {
    fin.beat_hz = scene_.fin_beat_hz * (0.8f + 0.4f * random_.unit());
    fin.phase_rad = det::kTwoPi * random_.unit();
    fin.until_change_s = random_.unit();
  }
}

void Swimmer::steer(Steer how, Vec2 point) {
  steer_ = how;
  steer_point_ = point;
}

Vec2 Swimmer::direction() const { return unit(heading_); }

Vec2 Swimmer::velocity_px_s() const { return direction() * (place_ == Place::away ? 0.0f : speed_ * length_px_); }

float Swimmer::around(float mean) { return mean * (0.5f + random_.unit()); }
float Swimmer::symmetric() { return 2.0f * random_.unit() - 1.0f; }

void Swimmer::advance(double dt_s) {
  pending_s_ += dt_s;
  while (pending_s_ > 0) {
    const float h = pending_s_ < static_cast<double>(kStepS) ? static_cast<float>(pending_s_) : kStepS;
    step(h);
    pending_s_ -= h;
    if (pending_s_ < 1e-7) pending_s_ = 0;
  }
}

void Swimmer::step(float h) {
  change_place(h);
  change_gait(h);
  if (scene_.holds_station) hold_station(h);
  else swim(h);
  beat(h);
  for (int side : {kLeft, kRight}) move_fin(side, h);
}

bool Swimmer::in_room(Vec2 p) const {
  return p.x >= room_lo_.x && p.y >= room_lo_.y && p.x <= room_hi_.x && p.y <= room_hi_.y;
}

void Swimmer::change_place(float h) {
  until_place_s_ -= h;
  switch (place_) {
    case Place::inside:
      if (scene_.leave_every_s <= 0 || until_place_s_ > 0) return;
      place_ = Place::leaving;
      goal_ = {unit(heading_).x > 0 ? size_.x + 2.0f * length_px_ : -2.0f * length_px_, pivot_.y};
      return;
    case Place::leaving:
      if (pivot_.x > -kOutside * length_px_ && pivot_.x < size_.x + kOutside * length_px_) return;
      place_ = Place::away;
      until_place_s_ = scene_.away_s;
      return;
    case Place::away:
      if (until_place_s_ > 0) return;
      place_ = Place::coming;
      goal_ = size_ * 0.5f;
      return;
    case Place::coming:
      if (!in_room(pivot_)) return;
      place_ = Place::inside;
      until_place_s_ = around(scene_.leave_every_s);
  }
}

void Swimmer::change_gait(float h) {
  if (scene_.hover_every_s > 0 && place_ == Place::inside) {
    until_rest_s_ -= h;
    if (until_rest_s_ <= 0) {
      resting_ = !resting_;
      until_rest_s_ = resting_ ? scene_.hover_s : scene_.hover_every_s;
    }
  }
  until_gait_s_ -= h;
  if (until_gait_s_ > 0) return;
  bursting_ = !bursting_ && !resting_;
  until_gait_s_ = around(bursting_ ? scene_.burst_s : scene_.coast_s);
}

void Swimmer::change_c_start(float h) {
  if (scene_.c_start_every_s <= 0) return;
  if (c_start_age_s_ >= 0) {
    c_start_age_s_ += h;
    if (c_start_age_s_ < scene_.c_start_s) return;
    c_start_age_s_ = -1;
    until_c_start_s_ = around(scene_.c_start_every_s);
    bursting_ = true;
    until_gait_s_ = scene_.burst_s;
    return;
  }
  until_c_start_s_ -= h;
  if (until_c_start_s_ > 0 || place_ != Place::inside || resting_ || !in_room(pivot_)) return;
  // Towards the middle, so that the burst after it has room; a fish that heads there already waits.
  const float inwards = turn_towards(size_ * 0.5f);
  const float least = 0.45f * scene_.c_start_turn_rad;
  if (det::abs(inwards) < 0.5f * least) return;
  c_start_age_s_ = 0;
  const float turn = det::clamp(det::abs(inwards), least, scene_.c_start_turn_rad);
  c_start_turn_rad_ = inwards < 0 ? -turn : turn;
}

float Swimmer::turn_towards(Vec2 goal) const {
  const Vec2 to = goal - pivot_;
  return det::wrap(det::atan2(to.y, to.x) - heading_);
}

bool Swimmer::near_wall() const {
  return place_ == Place::inside && !in_room(pivot_ + unit(heading_) * ((0.2f + 0.7f * speed_) * length_px_));
}

float Swimmer::wanted_turn(float h) {
  if (place_ != Place::inside) return det::clamp(2.5f * turn_towards(goal_), -kWallTurn, kWallTurn);
  if (near_wall()) return det::clamp(2.5f * turn_towards(size_ * 0.5f), -kWallTurn, kWallTurn);
  if (steer_ != Steer::free) {
    const float away = steer_ == Steer::away ? det::kPi : 0.0f;
    return det::clamp(2.5f * det::wrap(turn_towards(steer_point_) + away), -kWallTurn, kWallTurn);
  }
  until_wander_s_ -= h;
  if (until_wander_s_ <= 0) {
    until_wander_s_ = around(scene_.wander_s);
    wander_rad_s_ = symmetric() * scene_.wander_rad_s;
  }
  return resting_ ? 0.15f * wander_rad_s_ : wander_rad_s_;
}

void Swimmer::swim(float h) {
  change_c_start(h);
  if (place_ == Place::away) {
    speed_ = 0.0f;
    return;
  }
  const bool travels = place_ != Place::inside || steer_ != Steer::free;
  const bool brakes = near_wall();
  const float swims = bursting_ || travels ? scene_.burst_bl_s : scene_.cruise_bl_s;
  const bool lets_pass =
      steer_ == Steer::away && dot(unit(heading_), steer_point_ - pivot_) > -0.5f * length_px_;  // beside it or ahead
  const float wanted = resting_ ? 0.0f : lets_pass ? kPassingSpeed : brakes ? det::min(swims, kWallSpeed) : swims;
  follow(speed_, wanted, h, bursting_ || travels || brakes ? 0.35f : 0.8f);
  const float turn = wanted_turn(h);
  if (c_start_age_s_ >= 0) {
    // The turn and the bend rise and fall together as sin^2; the mean of sin^2 is 1/2.
    const float wave = det::sin(det::kPi * c_start_age_s_ / scene_.c_start_s);
    turn_rad_s_ = c_start_turn_rad_ * 2.0f / scene_.c_start_s * wave * wave;
    follow(bend_, (c_start_turn_rad_ < 0 ? -1.0f : 1.0f) * scene_.c_start_bend_rad * wave * wave, h, 0.03f);
  } else {
    follow(turn_rad_s_, turn, h, 0.22f);
    const float bend = det::clamp(0.9f * turn_rad_s_ / (speed_ + 0.5f), -scene_.bend_limit_rad, scene_.bend_limit_rad);
    follow(bend_, bend, h, 0.12f);
  }
  heading_ = det::wrap(heading_ + turn_rad_s_ * h);
  pivot_ += unit(heading_) * (speed_ * length_px_ * h);
}

void Swimmer::hold_station(float h) {
  speed_ = scene_.current_bl_s;
  if (place_ == Place::away) return;
  until_wander_s_ -= h;
  if (until_wander_s_ <= 0) {
    until_wander_s_ = 1.5f * around(scene_.wander_s);
    station_ = home_ + Vec2{symmetric() * scene_.drift_x_bl, symmetric() * scene_.drift_y_bl} * length_px_;
    station_turn_ = symmetric() * scene_.drift_rad;
  }
  // A damped spring to the drifting station, in body lengths.
  const Vec2 pull = (station_ - pivot_) * (1.0f / length_px_);
  velocity_ += (pull * 1.5f - velocity_ * 2.4f) * h;
  const float fast = length(velocity_);
  if (fast > kStationSpeed) velocity_ = velocity_ * (kStationSpeed / fast);
  pivot_ += velocity_ * (length_px_ * h);
  follow(turn_rad_s_, 1.2f * det::wrap(station_heading_ + station_turn_ - heading_), h, 0.3f);
  heading_ = det::wrap(heading_ + turn_rad_s_ * h);
  follow(bend_, det::clamp(1.3f * turn_rad_s_, -scene_.bend_limit_rad, scene_.bend_limit_rad), h, 0.12f);
}

void Swimmer::beat(float h) {
  const bool still = resting_ || c_start_age_s_ >= 0;
  const bool drives = bursting_ || place_ == Place::leaving || place_ == Place::coming;
  const float amplitude = still ? 0.03f : drives ? 0.34f + 0.12f * speed_ : 0.13f + 0.1f * speed_;
  follow(wave_, amplitude, h, c_start_age_s_ >= 0 ? 0.08f : 0.25f);
  wave_phase_ += det::kTwoPi * (0.7f + 1.6f * speed_) * h;
  if (wave_phase_ > det::kTwoPi) wave_phase_ -= det::kTwoPi;
}

void Swimmer::move_fin(int side, float h) {
  Fin& fin = fins_[side];
  fin.until_change_s -= h;
  const bool fast = speed_ > 0.8f * scene_.burst_bl_s || c_start_age_s_ >= 0;
  if (fast && !scene_.holds_station) {
    fin.target = 0.0f;  // folded, and not opened again at once
    fin.until_change_s = det::max(fin.until_change_s, 0.15f);
  } else if (fin.until_change_s <= 0) {
    const bool inner = side == kRight ? turn_rad_s_ > 0.4f : turn_rad_s_ < -0.4f;
    const float chance = inner ? 0.9f : scene_.fin_open_share;
    fin.target = random_.unit() < chance ? 0.65f + 0.35f * random_.unit() : 0.0f;
    fin.until_change_s = around(1.1f);
  }
  follow(fin.level, fin.target, h, 0.13f);
  fin.phase_rad += det::kTwoPi * fin.beat_hz * h;
  if (fin.phase_rad > det::kTwoPi) fin.phase_rad -= det::kTwoPi;
}

Posture Swimmer::posture() const {
  Posture p;
  p.pivot = pivot_;
  p.heading_rad = heading_;
  p.bend_rad = bend_;
  p.wave_rad = wave_;
  p.wave_phase_rad = wave_phase_;
  for (int side : {kLeft, kRight}) {
    const Fin& fin = fins_[side];
    p.fin_rad[side] = kFinFolded + fin.level * (kFinOpen - kFinFolded + scene_.fin_beat_rad * det::sin(fin.phase_rad));
  }
  return p;
}

}  // namespace nt::tank
