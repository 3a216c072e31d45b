// SPDX-License-Identifier: Apache-2.0
// The number of points that describe a fish's medial axis inside core, from head (0) to tail (kStations - 1).
#pragma once

namespace nt {

inline constexpr int kStations = 65;

}  // namespace nt
