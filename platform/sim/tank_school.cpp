// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_school.h"

#include "core/base/det_math.h"
#include "platform/sim/tank_raster.h"

namespace nt::tank {
namespace {

constexpr float kCompanionSize = 0.85f;   // of the target's length: the target is the one to pick
constexpr float kCompanionAfterS = 1.5f;  // each comes in so much after the one before it
constexpr float kKeepAway = 1.4f;         // BL of the target
constexpr float kOver = 0.3f;             // BL from the target's middle: it has swum over it
constexpr float kPassSpeed = 1.2f;        // BL/s
constexpr float kBeside = 1.4f;           // it comes from the side when along / across is below this
constexpr double kGoOnS = 1.2;            // and then swims straight on, so as not to stay over it

bool inside(const std::vector<Vec2>& polygon, Vec2 p) {  // even-odd
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i], b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

// Where to swim in order to pass over the target from its side: to where it will be, but from ahead or behind first to
// a place beside it.
Vec2 crossing_point(const Swimmer& target, Vec2 from, float length_px) {
  const Vec2 to = target.pivot() - from, ahead = target.direction();
  const float away_px = length(to);
  const Vec2 meets = target.pivot() + target.velocity_px_s() * (away_px / (kPassSpeed * length_px));
  const float along = det::abs(dot(to, ahead)), across = det::abs(cross(to, ahead));
  if (along < kBeside * across || away_px < 0.5f * length_px) return meets;
  const float side = cross(ahead, to) > 0.0f ? -1.0f : 1.0f;  // the one it is on
  return meets + right_of(ahead) * (side * length_px);
}

}  // namespace

School::School(const TankScene& scene, uint64_t seed, int width, int height)
    : size_{static_cast<float>(width), static_cast<float>(height)},
      cross_every_s_(static_cast<double>(scene.cross_every_s)),
      until_cross_s_(cross_every_s_) {
  TankScene row = scene;
  for (int i = 0; i <= scene.companions; ++i) {
    const float length_px = row.body_length * static_cast<float>(width);
    fish_.push_back({Swimmer(row, seed + static_cast<uint64_t>(i) * 7919, width, height),
                     FishModel(length_px, scene.caudal), length_px});
    row.body_length = scene.body_length * kCompanionSize;
    row.wait_s += kCompanionAfterS;
  }
}

void School::advance(double dt_s) {
  fish_[0].swimmer.advance(dt_s);
  for (std::size_t i = 1; i < fish_.size(); ++i) {
    steer_companion(i, dt_s);
    fish_[i].swimmer.advance(dt_s);
  }
}

// Far enough from the walls for two fish to part again.
bool School::amid(Vec2 p) const {
  const Vec2 off = p - size_ * 0.5f;
  return det::abs(off.x) < 0.37f * size_.x && det::abs(off.y) < 0.31f * size_.y;
}

void School::steer_companion(std::size_t i, double dt_s) {
  Swimmer& fish = fish_[i].swimmer;
  const Swimmer& target = fish_[0].swimmer;
  const float length_px = fish_[0].length_px;
  const float away_px = length(target.pivot() - fish.pivot());
  if (i == 1 && cross_every_s_ > 0) {
    until_cross_s_ -= dt_s;
    if (until_cross_s_ <= 0 && amid(target.pivot())) {
      if (away_px < kOver * length_px) until_cross_s_ = cross_every_s_;
      return fish.steer(Swimmer::Steer::towards, crossing_point(target, fish.pivot(), length_px));
    }
    if (cross_every_s_ - until_cross_s_ < kGoOnS)
      return fish.steer(Swimmer::Steer::towards, fish.pivot() + fish.direction() * (2.0f * length_px));
  }
  fish.steer(away_px < kKeepAway * length_px ? Swimmer::Steer::away : Swimmer::Steer::free, target.pivot());
}

void School::shape(std::vector<FishShape>& out) const {
  out.resize(fish_.size());
  for (std::size_t i = 0; i < fish_.size(); ++i) fish_[i].model.shape(fish_[i].swimmer.posture(), out[i]);
}

bool overlap(const FishShape& fish, const FishShape& other) {
  const Box a = box_of(fish.contour, 0), b = box_of(other.contour, 0);
  if (a.x0 >= b.x1 || b.x0 >= a.x1 || a.y0 >= b.y1 || b.y0 >= a.y1) return false;
  for (Vec2 p : fish.contour)
    if (inside(other.contour, p)) return true;
  for (Vec2 p : other.contour)
    if (inside(fish.contour, p)) return true;
  return false;
}

}  // namespace nt::tank
