// SPDX-License-Identifier: Apache-2.0
// Area, barycentre and principal axis of the region inside a closed contour ([F] section 4.1).
//
// The paper takes PCA over the pixels inside the contour; Green's theorem over the polygon gives the same moments in
// O(perimeter). Pixels; `axis` is a unit vector whose sign means nothing.
#pragma once
#include <span>

#include "core/base/vec2.h"

namespace nt {

struct Moments {
  float area = 0;  // pixels^2, positive when the contour runs clockwise on the screen
  Vec2 centroid;
  Vec2 axis{1, 0};             // eigenvector of the larger eigenvalue
  float major = 0, minor = 0;  // standard deviations along the axes
};

Moments polygon_moments(std::span<const Vec2> contour);

// Whether a point lies inside: of a fish bent into a C the barycentre does not.
bool encloses(std::span<const Vec2> contour, Vec2 p);

// Its area alone, with the same sign.
float polygon_area(std::span<const Vec2> contour);

}  // namespace nt
