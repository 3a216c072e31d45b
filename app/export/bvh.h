// SPDX-License-Identifier: Apache-2.0
// Motion as a BVH file: the spine in two chains from the centre, and the pectoral fins.
//
// Y up, -Z ahead (what Blender's importer expects), so the water's surface is the X-Z plane: x of the picture is X, y of
// the picture is Z. The fish's axis is `length_units` long. Rotations in degrees in the order Z X Y; only Y turns. At rest the
// fish is straight and looks along -Z. A frame without a pose repeats the last one.
#pragma once
#include <span>
#include <string>

#include "app/take/fish_shape.h"

namespace nt {

std::string bvh(std::span<const Motion> motions, const FishShape& shape, double fps, double length_units);

}  // namespace nt
