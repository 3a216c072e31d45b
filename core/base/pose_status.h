// SPDX-License-Identifier: Apache-2.0
// Why a frame has a pose or none. In base, because tracking (segment/) decides it and the pose (landmarks/) carries it.
#pragma once
#include <cstdint>

namespace nt {

enum class PoseStatus : uint8_t {
  ok,        // a pose
  partial,   // the fish touches the frame's edge: no pose
  occluded,  // merged with another blob, or closed into a ring: no pose
  absent,    // no fish has been selected, or none is there to select
  lost,      // the fish that was tracked is not found
  relearn,   // the background is being learned: masks mean nothing yet
};

}  // namespace nt
