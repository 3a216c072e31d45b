// SPDX-License-Identifier: Apache-2.0
// What water and lamps do to the picture: caustics, ripples, bubbles, particles, mirror images at the wall, changing
// light.
//
// Input: a Canvas (the composed picture) and the time in seconds; every effect is a function of that time alone, so that
// nothing drifts or grows in a long run. Output: the canvas, changed in place. Frame pixels; lengths scale with the
// frame's width. An effect that the scene does not ask for costs nothing; at 960x544 surface light costs 0.4 ms, lamps
// 0.2 ms, drifters and mirror below 0.1 ms. The camera's own motion (tank_hand.h) does not move what is drawn here.
#pragma once
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/base/vec2.h"
#include "platform/sim/tank_scenes.h"

namespace nt::tank {

// Light in sixteenths of a luma step. The stride is a multiple of 32.
struct Canvas {
  int width = 0, height = 0, stride = 0;
  std::vector<int16_t> light;
  int16_t* row(int y) { return light.data() + static_cast<std::size_t>(y) * stride; }
};

// The moving surface: a network of bright lines (two tiles that slide across each other; the darker one counts) and
// trains of ripples, both as a factor about 1.
class SurfaceLight {
 public:
  SurfaceLight(const TankScene& scene, uint64_t seed, int width);
  void apply(double t_s, Canvas& canvas) const;

 private:
  struct Tile {
    std::vector<uint8_t> cells;  // kTile rows, each long enough to be read from any column
    Vec2 speed_px_s;
    const uint8_t* row(int y, double t_s) const;
    int stride = 0;
  };
  Tile repeated(const std::vector<uint8_t>& cells, Vec2 speed_px_s, int width) const;
  float caustics_, ripples_;
  int mean_ = 0;  // of the network
  Tile network_[2], ripple_;
};

// Bubbles that rise to the frame's upper edge and grow, particles that drift with the water; both between fish and camera.
class Drifters {
 public:
  Drifters(const TankScene& scene, uint64_t seed, int width, int height);
  void draw(double t_s, Canvas& canvas) const;

 private:
  struct Drifter {
    Vec2 start, speed_px_s;
    float radius_px = 0, luma = 0, sway_px = 0, sway_rad_s = 0, phase_rad = 0;
    bool bubble = false;
  };
  void draw_one(const Drifter& drifter, double t_s, Canvas& canvas) const;
  std::vector<Drifter> drifters_;
  Vec2 size_;
  float unit_px_;
};

// Glass walls along the frame's upper and lower edge: darker strips in which the tank is mirrored. A fish before the
// wall hides it: fish_alpha, width x height with the canvas's stride, 255 = opaque.
class WallMirror {
 public:
  WallMirror(const TankScene& scene, int width);
  void apply(const std::vector<uint8_t>& fish_alpha, Canvas& canvas) const;

 private:
  void mirror_row(int y, int from, const std::vector<uint8_t>& fish_alpha, Canvas& canvas) const;
  float strength_;
  int depth_px_;
};

// Brightness of the lamps: switched on at some time, slow drift, and the mains' flicker, which a rolling shutter turns
// into bands.
class Lamps {
 public:
  explicit Lamps(const TankScene& scene);
  bool steady() const { return steady_; }
  float at(double t_s, float row_share) const;  // row_share: 0 = the frame's first row, 1 = its last
  void apply(double t_s, Canvas& canvas) const;

 private:
  TankScene scene_;
  bool steady_;
};

}  // namespace nt::tank
