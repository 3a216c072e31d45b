// SPDX-License-Identifier: Apache-2.0
// A character posed by one frame of a clip, with handles: points that can be taken hold of, each for one number of the motion.
//
// Motion + where frame pixels lie on the screen -> vertices and handles, scene pixels. A handle that is pulled ->
// the number that brings it nearest to where it is pulled. Nothing is filtered over time: a frame looks the same however it is
// come to.
// The number is found on the posed character itself, by Gauss-Newton in one unknown, so it holds whatever the retargeting
// does with it (fins that open less than the fish's, other numbers of joints).
// Cost: Retarget::pose (0.03 ms for 2,500 vertices); value_for() some ten of them.
#pragma once
#include <vector>

#include "app/aligned_block.h"
#include "app/character_edit/figure_view.h"
#include "app/wardrobe.h"
#include "core/character/retarget.h"
#include "core/motion/property.h"

namespace nt {

struct Handle {
  MotionProperty property;  // centre_x stands for the whole position
  Vec2 at;
};

class Puppet {
 public:
  // The wardrobe's first character, as long as the fish was at first (pixels). The wardrobe must outlive the puppet.
  Puppet(const Wardrobe& wardrobe, float init_len_px);

  void pose(const Motion& motion, const FigureView& view);
  const Retarget& posed() const { return *retarget_; }
  const Character& character() const { return wardrobe_->character(0); }
  float length_px() const { return init_len_px_; }  // of the drawing, frame pixels

  // Of the last pose, for a motion with such bones.
  std::vector<Handle> handles() const;
  // Poses the puppet anew. `property` must have a handle and not be the position.
  float value_for(Motion motion, MotionProperty property, Vec2 pulled_to, const FigureView& view);

 private:
  Vec2 handle_at(MotionProperty property) const;
  float course_towards(const Motion& motion, Vec2 at, const FigureView& view) const;
  Vec2 with_value(Motion& motion, MotionProperty property, float value, const FigureView& view);

  const Wardrobe* wardrobe_;
  float init_len_px_;
  AlignedBlock memory_;
  Retarget* retarget_;  // lives in memory_
  Motion motion_;       // of the last pose
  float scale_ = 1;     // scene pixels a frame pixel
};

}  // namespace nt
