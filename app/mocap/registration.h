// SPDX-License-Identifier: Apache-2.0
// Lays one frame of markers over a mesh: the turn, shift and scale that bring them nearest to its surface.
//
// Input: marker positions and mesh vertices, each in its own unit and axes. Output: mesh = scale turn marker + shift.
// Iterated closest points (Besl and McKay 1992) with scale (Umeyama 1991) from all 24 ways of laying axes on axes; the
// nearest wins. A body is nearly its own mirror image front to back, so `axes` can say which of the 24 it is. The mesh must stand roughly in that frame's pose. A marker's place after registration is kept as it is, off the
// surface or not: that offset is what makes up for other proportions ([L]'s implicit retargeting).
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/vec3.h"

namespace nt {

struct Registration {
  Quat turn;
  float scale = 1.0f;
  Vec3 shift;
  float rms = 0.0f;  // of the markers from the mesh, in its unit
  Vec3 operator()(Vec3 p) const { return rotate(turn, scale * p) + shift; }
};

// "x,z,-y": which axes of the marker file the mesh's x, y and z are. UserError (code 2) if it is no turn.
Quat parse_axes(const std::string& axes);

// Markers whose places on the mesh are known, one for each: those that are not seen are left out. UserError with fewer than
// three.
Registration register_to_places(std::span<const Vec3> markers, std::span<const Vec3> places);

// Markers that are not seen are left out; UserError with fewer than four. turns: what to start from; empty: all 24.
Registration register_markers(std::span<const Vec3> markers, const std::vector<Vec3>& mesh,
                              std::span<const Quat> turns);

}  // namespace nt
