// SPDX-License-Identifier: Apache-2.0
// Draws upright, shows turned: a framebuffer of the upright picture's size, and a quad that lays it on the screen.
//
// Whatever draws (scenes, buttons) knows nothing of the turn. Cost: the picture once more through the GPU, and its memory
// (RGBA and 16 bits of depth). A GLES 3.0 context must be current everywhere. Throws UserError when the driver cannot.
#pragma once
#include "platform/display.h"

namespace nt {

class TurnedTarget {
 public:
  explicit TurnedTarget(int rotation_deg);
  ~TurnedTarget();
  TurnedTarget(const TurnedTarget&) = delete;
  TurnedTarget& operator=(const TurnedTarget&) = delete;
  // What is drawn from now on goes into the upright picture of a screen of this size.
  void begin(DisplaySize screen);
  // Lays it on the screen, which is bound afterwards.
  void show(DisplaySize screen);

 private:
  void resize(DisplaySize upright);

  int rotation_deg_;
  DisplaySize size_;  // upright
  unsigned program_ = 0, vertex_array_ = 0, framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

}  // namespace nt
