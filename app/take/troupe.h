// SPDX-License-Identifier: Apache-2.0
// The fish of a take, each with an actor, drawn frame by frame.
//
// Performances of equal length + characters, which are handed out in turn -> scenes. Frames are shown in order, gaps allowed;
// after the last one the first follows: a loop has been swum once before its first frame, so that it closes.
#pragma once
#include <vector>

#include "app/take/performance.h"

namespace nt {

class Troupe {
 public:
  // The wardrobe must outlive it.
  Troupe(const Wardrobe& wardrobe, std::vector<Performance> performances, const Pane& pane);
  std::size_t frames() const { return performances_.front().frames.size(); }
  double fps() const { return performances_.front().fps; }
  // Poses everybody at frame i, `passed` frames (0: none) after the one shown last.
  void show(std::size_t i, int passed);
  void draw(Scene& scene) const;
  void next_character();
  std::size_t costume() const { return actors_.front().costume(); }

 private:
  const Wardrobe& wardrobe_;
  std::vector<Performance> performances_;
  Pane pane_;
  std::vector<Actor> actors_;
};

// The whole frame of a take, drawn `scale` times as large; sides are even.
Pane take_pane(const TakeInfo& info, float scale);

}  // namespace nt
