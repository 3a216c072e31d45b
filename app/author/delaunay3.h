// SPDX-License-Identifier: Apache-2.0
// Delaunay tetrahedra of points, by Qhull. Off the frame path.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vec3.h"

namespace nt {

// Four indices each, positive volume; tetrahedra without volume (Qhull's, of points on one sphere) are left out.
// Throws UserError when Qhull finds no solid in the points.
std::vector<std::array<uint16_t, 4>> delaunay3(const std::vector<Vec3>& points);

}  // namespace nt
