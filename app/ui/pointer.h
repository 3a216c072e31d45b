// SPDX-License-Identifier: Apache-2.0
// Mouse and finger -> one pointer with one button, one change a frame.
//
// Input: what happened since the last frame, in order, scene pixels. Output: the pointer's state for each frame.
// A user interface that is built anew each frame (Dear ImGui) sees a press only where the pointer already is. So a finger
// is first put where it touches, pressed a frame later, released, and taken away a frame after that, or the button under
// it would stay lit. A press and a release between two frames become two frames. Of several fingers the first counts.
// Dear ImGui does all this itself from 1.89.5 on; Debian 12 has 1.86.
#pragma once
#include <cstdint>
#include <deque>

#include "core/base/vec2.h"

namespace nt {

struct PointerEvent {
  enum class Kind : uint8_t { move, press, release } kind = Kind::move;
  Vec2 at;
  bool finger = false;
  int64_t finger_id = 0;  // which finger
};

struct PointerState {
  Vec2 at;
  bool over = false;  // there is a pointer at all
  bool down = false;
  bool finger = false;
};

class PointerQueue {
 public:
  void push(const PointerEvent& event);
  // The state for the next frame; the last one again when nothing has happened.
  PointerState next();
  bool waiting() const { return !states_.empty(); }

 private:
  void add(const PointerState& state) { states_.push_back(state); }
  void move(const PointerState& state);

  std::deque<PointerState> states_;
  PointerState last_;  // the last one added
  PointerState now_;   // the last one handed out
  bool touching_ = false;
  int64_t finger_id_ = 0;
};

}  // namespace nt
