// SPDX-License-Identifier: Apache-2.0
// A take's motion at evenly spaced moments: what play and export draw, frame by frame.
//
// Edited take + rate, range, speed -> one Sighting a frame, motions in pixels of the working frame. Between two recorded
// frames the motion goes straight (core/motion/inbetween.h). A frame without a pose whose neighbours with one are at most
// kBridge_s apart lies between them; in a longer gap the last pose is held and `seen` is false, before the first pose the
// first one. Cost: O(frames).
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "app/actor.h"
#include "app/take/edited.h"

namespace nt {

inline constexpr double kBridge_s = 0.25;

struct Moments {
  struct Range {
    int64_t first = 0, last = 0;  // frames of the edited take, both inside
  };
  std::optional<double> rate;  // frames a second; unset: the take's own
  std::optional<Range> range;  // unset: all
  bool loop =
      false;  // closed as the edit `loop` does: the fish swims on the spot, and after the last frame comes the first
  double speed = 1;
};
// "30:600". Throws UserError.
Moments::Range parse_range(const std::string& option, const std::string& text);

struct Performance {
  double fps = 0;
  bool loop = false;
  Seam seam;  // of the loop
  std::vector<Sighting> frames;
};

// Throws UserError: frames that the take does not have, more frames than can be.
Performance performance(const EditedTake& take, const Moments& moments);
bool has_pose(const Performance& performance);

// Poses the actor at each frame in turn and calls `frame` with its number. Scene pixels are pixels of the working frame
// seen through `pane`. A loop has been swum once before, so that the actor's filters close it as well. `before`: how the
// actor stands until the fish is seen, not at all or in its first pose.
enum class Before : uint8_t { unposed, first_pose };
void perform(Actor& actor, const Performance& performance, const Pane& pane, Before before,
             const std::function<void(std::size_t)>& frame);

}  // namespace nt
