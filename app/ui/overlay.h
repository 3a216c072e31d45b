// SPDX-License-Identifier: Apache-2.0
// What capture sees, drawn over the camera's picture: outline (white), midline (cyan), head (red), tail (blue), fin tips
// (green), junctions (yellow), direction (arrow), other blobs (grey boxes), and a line with frame number and status.
//
// update() takes a copy of the last step's pose; draw() may then be called any number of times, with the same picture.
#pragma once
#include <vector>

#include "app/session.h"
#include "app/ui/pane.h"
#include "app/ui/text.h"
#include "core/scene/scene.h"

namespace nt {

class Overlay {
 public:
  explicit Overlay(const Pane& pane) : pane_(pane), text_(kFirstTextPicture) {}
  void update(Session& session, bool show_blobs = false);
  void draw(Scene& scene) const;

 private:
  void take_pose(Session& session);
  void take_blobs(Session& session);

  Pane pane_;
  Picture picture_;
  std::vector<Vec2> outline_, midline_, fins_, junctions_, arrow_;
  std::vector<Vec2> blob_corners_;  // four a blob
  Vec2 head_, tail_;
  bool has_pose_ = false;
  Text text_;
};

}  // namespace nt
