// SPDX-License-Identifier: Apache-2.0
// How well a character bore its swim: triangles that turned over, where, and how far its fins' areas strayed.
//
// One Distortion (core/character/distortion.h) a video frame -> the "character" object of the JSON report (docs/FORMATS.md).
// Places are in pixels of the source video. Cost: a few comparisons a frame; no allocation in add().
#pragma once
#include <cstdint>

#include <nlohmann/json.hpp>

#include "core/character/distortion.h"

namespace nt {

class ShapeReport {
 public:
  void add(int64_t frame, const Distortion& distortion, Vec2 where_px);
  nlohmann::ordered_json json(const Character& character) const;

 private:
  int64_t poses_ = 0, poses_with_turned_ = 0, turned_ = 0;
  int most_ = 0;  // turned triangles in one frame
  int64_t most_frame_ = 0;
  Vec2 most_where_px_;
  float least_area_[kMaxFins] = {1, 1, 1, 1}, most_area_[kMaxFins] = {1, 1, 1, 1};
};

}  // namespace nt
