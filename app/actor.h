// SPDX-License-Identifier: Apache-2.0
// The drawing that swims: a character, retargeted to the fish, posed between the last two video frames.
//
// It appears where the fish is and as long as the fish was in its first tracked frame: Eq 15 scales the world by
// body_len / init_len, and the placement's zoom takes that back, so the scene stays the fish's own.
// Not drawn before the fish was first seen; when the fish is lost the last pose is held and fades to a third.
// Cost: Retarget::pose once a drawn frame (well under 0.1 ms for 2,500 vertices).
#pragma once
#include <string>

#include "app/aligned_block.h"
#include "app/author/character_file.h"
#include "app/session.h"
#include "app/ui/pane.h"
#include "core/character/retarget.h"
#include "core/scene/scene.h"

namespace nt {

// A character file, or a picture or mesh that is turned into a character on the spot. Throws UserError.
LoadedCharacter load_character(const std::string& path);

class Actor {
 public:
  explicit Actor(const std::string& path);

  // The session has taken a step: its motion is the new end of what is played.
  void see(Session& session);
  // Poses the character at t in (0, 1] between the last two steps; dt_s since the last call.
  void pose(float t, float dt_s, const Pane& pane);
  void draw(Scene& scene) const;

  const Retarget& retarget() const { return *retarget_; }

 private:
  LoadedCharacter character_;
  AlignedBlock memory_;
  Retarget* retarget_ = nullptr;  // lives in memory_
  Motion previous_, current_;
  float init_len_ = 0;      // 0: not seen yet
  int missed_ = 0;          // video frames without a pose since the last one
  bool after_gap_ = false;  // the next pose is taken as it is, unfiltered
  bool posed_ = false;
};

}  // namespace nt
