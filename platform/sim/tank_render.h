// SPDX-License-Identifier: Apache-2.0
// The picture of the simulated aquarium: gravel, shadow, fish, noise.
//
// Input: FishShapes in frame pixels, the time, how the camera has moved. Output: width x height luma, row stride a multiple of 32; rgb8 on request, whose
// BT.601 luma is the luma picture (to rounding). Gravel and noise are made once; a frame costs the fish's box plus one
// pass over the frame that adds noise: about 1 ms at 960x544; what a scene adds to it is in tank_water.h. Light is kept in sixteenths of a luma step until the end.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/image_view.h"
#include "core/base/random.h"
#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_hand.h"
#include "platform/sim/tank_raster.h"
#include "platform/sim/tank_scenes.h"
#include "platform/sim/tank_skin.h"
#include "platform/sim/tank_water.h"

namespace nt::tank {

// Pebbles of several sizes with this mean and standard deviation, width x height.
std::vector<float> make_gravel(int width, int height, float mean, float sd, uint64_t seed);

class Renderer {
 public:
  Renderer(const TankScene& scene, uint64_t seed, int width, int height);
  // The fish in the order in which they lie, the uppermost last, as the camera sees them: frame pixels.
  LumaView render(std::span<const FishShape> fish, double t_s, const Similarity& frame_from_tank);
  std::span<const uint8_t> rgb();  // of the frame rendered last

 private:
  void lay_gravel(const Similarity& frame_from_tank);
  void draw_shadow(const FishShape& shape);
  void draw_fish(const FishShape& shape);
  void map_skin(const FishShape& shape);
  void map_skin_segment(const FishShape& shape, int step);
  void blend_row(const FishShape& shape, int y, int x0, int x1);
  void add_noise();
  float light(int x, int y) const { return light_x_[x] + light_y_[y]; }  // vignetting, about 1

  TankScene scene_;
  Random random_;
  int width_, height_, stride_;
  int margin_;  // of gravel beyond the frame's edges, for a camera that moves
  std::vector<float> light_x_, light_y_;
  std::vector<Skin> skin_;              // of the fish in body coordinates, kSkinS x kSkinN
  Canvas gravel_, work_;                // gravel: the frame and its margin
  std::vector<uint32_t> gravel_pairs_;  // each pixel and, in the upper half, the one below it; for a moving camera
  SurfaceLight surface_;
  Drifters drifters_;
  WallMirror wall_;
  Lamps lamps_;
  std::vector<int16_t> noise_;
  std::vector<uint8_t> luma_, rgb_;
  Coverage shadow_, body_, fins_[2];
  Box fish_box_;  // of the fish being drawn; may reach past the frame
  struct BodyPoint {
    float s = 0, n = 0;
    bool mapped = false;
  };
  std::vector<BodyPoint> map_;       // body coordinates of every pixel of fish_box_
  std::vector<uint8_t> fish_alpha_;  // how much of each pixel is fish, stride x height
  bool rgb_ready_ = false;
};

}  // namespace nt::tank
