// SPDX-License-Identifier: Apache-2.0
// One drawing that swims: it follows what was seen of one fish, posed between the last two video frames.
//
// It appears where the fish is and as long as the fish was in its first tracked frame: Eq 15 scales the world by
// body_len / init_len, and the placement's zoom takes that back, so the scene stays the fish's own.
// Not drawn before the fish was first seen; when the fish is lost the last pose is held and fades to a third.
// It can change into another character of the wardrobe at any time. Cost: Retarget::pose once a drawn frame (well under
// 0.1 ms for 2,500 vertices); no allocation after the constructor.
#pragma once
#include <vector>

#include "app/aligned_block.h"
#include "app/ui/pane.h"
#include "app/wardrobe.h"
#include "core/character/retarget.h"
#include "core/scene/scene.h"

namespace nt {

// What one fish did in one video frame; without a pose only `seen` counts.
struct Sighting {
  bool seen = false;
  float init_len = 0;  // its axis length in the first tracked frame, pixels: another value is another fish
  Motion motion;
};

class Actor {
 public:
  // `size`: of the drawing, against the fish's. The wardrobe must outlive the actor.
  Actor(const Wardrobe& wardrobe, std::size_t costume, float size = 1);

  void wear(std::size_t costume);  // from the next pose on
  void see(const Sighting& sighting);
  // Poses the character at t in (0, 1] between the last two sightings; dt_s since the last call.
  void pose(float t, float dt_s, const Pane& pane);
  void draw(Scene& scene) const;

  bool seen() const { return seen_; }  // in the last sighting
  const Retarget& retarget() const { return *fittings_[costume_]; }
  const Character& character() const { return wardrobe_->character(costume_); }
  std::size_t costume() const { return costume_; }
  float zoom(const Pane& pane) const;  // scene pixels a character unit

 private:
  void pack();

  const Wardrobe* wardrobe_;
  std::size_t costume_;
  float size_;
  AlignedBlock memory_;
  std::vector<Retarget*> fittings_;  // one a character, in memory_
  LatticeSkin skin_;                 // where the renderer places the vertices
  std::vector<float> packed_;        // of its lattice, as large as the largest
  Motion previous_, current_;
  float init_len_ = 0;      // 0: not seen yet
  int missed_ = 0;          // video frames without a pose since the last one
  bool after_gap_ = false;  // the next pose is taken as it is, unfiltered
  bool seen_ = false, posed_ = false;
};

}  // namespace nt
