// SPDX-License-Identifier: Apache-2.0
// A skeleton for a mesh that has none: a tree of curves along the middle of its limbs. Off the frame path.
//
// Input: any triangle mesh. Output: joints in the mesh's unit and axes, the root in its thickest part, one chain a limb; no
// limits. Where a limb bends by more than a fifth of a cell's share it has a joint, and every joint is named by its place.
// Method: TEASAR (Sato et al., "TEASAR: tree-structure extraction algorithm for accurate and robust skeletons", 2000) on the
// solid cells of solid_grid.h: paths from the cell farthest from the root back to the tree, cheap along the middle and dear
// along the surface; what a path's own thickness reaches is done with; then the next farthest. Paths are smoothed and cut
// into straight bones (Douglas and Peucker 1973).
// Cost: 0.1 s. Errors: UserError with one line for a mesh without a solid.
#pragma once
#include "app/author/lattice_builder.h"

namespace nt {

SkeletonSpec curve_skeleton(const TriangleMesh& mesh);

}  // namespace nt
