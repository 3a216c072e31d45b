// SPDX-License-Identifier: Apache-2.0
// Which end is the head, looked at over a whole recording: a two-state Viterbi pass.
//
// Per recorded pose what that frame says of its own order, and whether the order continues from the pose before
// -> for every pose whether head and tail must be exchanged.
// Model: hidden state of a pose: its head is the head (kept), or its tail is (turned). A frame's evidence is the log odds of
// `kept` from shape, contrast and travel alone; `continues` is the log odds that this pose has the same end for a head as
// the pose before (negative where the live filter turned the fish round, 0 where nothing is known, after a gap).
// The forward half runs with the recording and keeps two bits a pose (one backpointer for each state) and one number, so a
// recording of any length needs no more than that; the backward half replaces the bits by the answer, in place.
// Cost: a few operations a pose. Source: Viterbi 1967; the live filter (landmarks/body) sees the past only, this the future
// too, so a wrong start or a wrong turn is put right from its first frame on.
#pragma once
#include <cstdint>
#include <span>

#include "core/landmarks/order_step.h"

namespace nt {

class OrderPass {
 public:
  // The backpointers of this pose, to be kept for trace_back.
  uint8_t add(const OrderStep& step);
  // `steps`: what add() returned, in order -> 1 for each pose that must be turned, 0 for the others.
  void trace_back(std::span<uint8_t> steps) const;

 private:
  bool started_ = false;
  float lead_ = 0;  // log likelihood of the best path that ends kept, less that of the best that ends turned
};

}  // namespace nt
