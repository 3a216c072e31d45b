// SPDX-License-Identifier: Apache-2.0
#include "app/ui/pointer.h"

namespace nt {

// A move replaces the one before it that nobody has seen yet; a change of the button stays a frame of its own.
void PointerQueue::move(const PointerState& state) {
  const bool before = states_.size() > 1 ? states_[states_.size() - 2].down == state.down
                                         : states_.size() == 1 && now_.down == state.down && now_.over;
  const bool merges = before && states_.back().down == state.down && states_.back().over;
  if (merges) states_.back() = state;
  else add(state);
}

void PointerQueue::push(const PointerEvent& event) {
  using Kind = PointerEvent::Kind;
  PointerState state{event.at, true, last_.down, event.finger};
  if (event.finger) {
    const bool other = touching_ && event.finger_id != finger_id_;
    if (other || (!touching_ && event.kind != Kind::press)) return;
    state.down = true;
  } else if (touching_) {
    return;  // a finger has the pointer
  }
  switch (event.kind) {
    case Kind::move:
      move(state);
      break;
    case Kind::press:
      if (event.finger) {
        state.down = false;
        add(state);
        touching_ = true, finger_id_ = event.finger_id;
      }
      state.down = true;
      add(state);
      break;
    case Kind::release:
      state.down = false;
      add(state);
      if (event.finger) {
        state.over = false;
        add(state);
        touching_ = false;
      }
      break;
  }
  last_ = state;
}

PointerState PointerQueue::next() {
  if (states_.empty()) return now_;
  now_ = states_.front();
  states_.pop_front();
  return now_;
}

}  // namespace nt
