// SPDX-License-Identifier: Apache-2.0
// What one pose says of its own order of head and tail; core/motion/order.h looks at a whole recording of them.
#pragma once

namespace nt {

// Both in natural log odds. `evidence`: the end that the pose calls the head is the head, from this frame's shape, contrast
// and travel alone. `continues`: the pose has the same end for a head as the pose before it; negative where the live filter
// turned the fish round, 0 where nothing is known (the first pose, or one after a long gap).
struct OrderStep {
  float evidence = 0;
  float continues = 0;
};

}  // namespace nt
