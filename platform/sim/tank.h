// SPDX-License-Identifier: Apache-2.0
// A simulated aquarium seen from above, with known truth: the camera that runs in CI.
//
// scene + seed + size -> a luma frame and the truth of it: every attribute of [F] Table 1, the fish's mask, its contour.
// Repeatable: the same scene, seed, size and frame number give the same bytes on every target (no libm: det_math only).
// The fish is a textured body whose outline is a width profile along a bending midline, with a forked or rounded
// caudal fin and two pectoral fins that open, fold and beat on their own; fins are semi-transparent. It swims by a
// travelling wave whose amplitude grows towards the tail, with speed changes, turns and burst-and-coast. Behind it lies
// gravel; a soft shadow falls beside it; the sensor is noisy. Scenes add other fish, changing light, a moving surface,
// dirt, a camera in the hand. The truth is the target's, in the pixels of the frame as it is seen.
// Frame of reference: frame pixels, x right, y down.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/image_view.h"
#include "core/landmarks/fish_pose.h"

namespace nt {

enum class CaudalFin : uint8_t { forked, rounded };

// A scene is data: a row of tank_scenes.cpp. Lengths are in body lengths (BL) or pixels as the names say.
struct TankScene;
const TankScene* find_tank_scene(const std::string& name);  // null when there is none
std::vector<std::string> tank_scene_names();

struct TankTruth {
  FishPose pose;                 // status ok when the fish is wholly visible; fins with confidence 0 are folded
  bool visible = false;          // wholly inside the frame
  bool covered = false;          // another fish lies over a part of it
  std::vector<FishPose> others;  // of the other fish; points under another fish count as seen
  std::vector<Vec2> midline;     // dense, head to tail
  std::vector<Vec2> contour;     // closed, body with caudal and open pectoral fins
  std::vector<uint8_t> mask;     // width x height, 255 = fish (coverage of at least one half)
};

struct TankSettings {
  std::string scene = "calm";
  uint64_t seed = 1;
  int width = 960;
  int height = 544;
  double fps = 30;
};

inline constexpr int kTankLeastWidth = 64, kTankLeastHeight = 48;
inline constexpr int kTankMostWidth = 7680, kTankMostHeight = 4320;

class Tank {
 public:
  static bool size_fits(int width, int height) {
    return width >= kTankLeastWidth && height >= kTankLeastHeight && width <= kTankMostWidth &&
           height <= kTankMostHeight;
  }
  explicit Tank(const TankSettings& settings);
  ~Tank();
  // Renders frame n = 0, 1, 2, ... in order. The view is valid until the next call.
  LumaView render_next();
  // Colour of the same frame, rgb8, for showing.
  std::span<const uint8_t> rgb() const;
  // Truth of the frame rendered last; mask and contour are filled only when asked for (they cost time).
  const TankTruth& truth(bool with_mask = false);
  int64_t frame_index() const;  // of the frame rendered last, -1 before the first

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nt
