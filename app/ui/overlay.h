// SPDX-License-Identifier: Apache-2.0
// What capture sees, drawn over the camera's picture: outline (white), midline (cyan), head (red), tail (blue), fin tips
// (green), junctions (yellow), direction (arrow), other blobs (grey boxes), and a line with frame number and status. Of several fish each has its number;
// the outline of the target is white, that of the others grey.
//
// update() takes a copy of what was seen but its picture; draw() may then be called for as long as that is there.
#pragma once
#include <vector>

#include "app/observation.h"
#include "app/ui/pane.h"
#include "app/ui/text.h"
#include "core/scene/scene.h"
#include "platform/sim/tank.h"

namespace nt {

class Overlay {
 public:
  explicit Overlay(const Pane& pane) : pane_(pane), text_(kFirstTextPicture) {}
  void update(const Observation& seen, bool show_blobs = false);
  // The true midline of the tank's fish, a thin line; after update(). `scale`: tank pixels a working pixel.
  void show_truth(const TankTruth& truth, float scale);
  void draw(Scene& scene) const;

 private:
  // One fish.
  struct Drawn {
    std::vector<Vec2> outline, midline, fins, junctions, arrow;
    Vec2 head, tail;
    bool seen = false, target = false;
  };
  void take_pose(const FishSeen& fish, Drawn& drawn) const;
  void draw_fish(const Drawn& drawn, const Text* number, Scene& scene) const;
  void take_blobs(std::span<const BlobView> blobs);

  Pane pane_;
  Picture picture_;
  std::vector<Drawn> fish_;
  std::vector<Text> numbers_;  // one a fish, where there are several
  std::vector<Vec2> truth_;
  std::vector<Vec2> blob_corners_;  // four a blob
  Text text_;
};

}  // namespace nt
