// SPDX-License-Identifier: Apache-2.0
// Fine tuning: one edit of one number in one frame moves its neighbours along, [F] section 6.
//
// Sequence of motions (all of one u_num, l_num) + property u, frame r, new value M' -> the sequence N, edited in place.
// Frames count from 0. Angles must be continuous from frame to frame (unwrapped), as motion_from_pose makes them.
// Several edits are applied one after the other, each to what the last one left: [F]'s M is the sequence as it stands.
// Source: [F] Eqs 16-21. Differs from it:
// - Eq 18 pulls angles to 0 where it reverses a motion (I = 0); here it is written about the rest pose:
//   N_i = M_0 + I (1-f)(M_i - M_0) + f (M' - M_0), the same as Eq 18 for I = 1.
// - Eq 21 divides by zero where r = p or r = q: f(r) = 1, and that side is empty.
// - A frame exactly on the rest pose is on no side and ends the window: fins that were not seen lie there for long, and an
//   edit of one stroke must not reach through them to the next. Measured angles never are, so [F]'s own cases stay.
// - r itself on the rest pose (M_r = M_0) has no side of its own: the side the edit takes it to is the window's, which
//   goes on over what rests on both sides of r up to the end of the next stroke.
// - dir and centre, which [F] leaves out, have no rest pose. Their window is given, and the edit is a displacement that
//   fades out over it: N_i = M_i + f (M' - M_r).
// Cost: O(frames of the window); no memory.
#pragma once
#include <span>

#include "core/motion/property.h"

namespace nt {

struct EditWindow {
  int p = 0, q = 0;  // first and last frame, both inside
};

// Eqs 19, 20: the run of frames around r on r's side of `rest`. 0 <= r < sequence.size().
EditWindow edit_window(std::span<const Motion> sequence, MotionProperty u, float rest, int r, float edited);
// `radius` frames to either side, as far as the sequence goes: for the path.
EditWindow path_window(int frames, int r, int radius);

// Eq 21: 1 at r, 0 at p and q, and outside.
float influence(int i, int r, EditWindow window);

// Eq 18; u is an angle, not of the path.
void edit_angle(std::span<Motion> sequence, MotionProperty u, float rest, int r, float edited, EditWindow window);
// u is of the path.
void edit_path(std::span<Motion> sequence, MotionProperty u, int r, float edited, EditWindow window);

}  // namespace nt
