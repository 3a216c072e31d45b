// SPDX-License-Identifier: Apache-2.0
// A take's poses as JSON: for each frame the fish's points, angles and confidences, and the character's control points.
//
// Performance + the fish's shape (+ an actor that swims it) -> text; docs/FORMATS.md has the keys. Points are in pixels of
// the source (x right, y down), angles in radians in the fish's own frame. Cost: about 2 kB a frame.
#pragma once
#include <string>

#include "app/take/performance.h"

namespace nt {

// `wardrobe`: of the character, or null.
std::string pose_json(const EditedTake& take, const Performance& performance, const Wardrobe* wardrobe);

}  // namespace nt
