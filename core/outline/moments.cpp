// SPDX-License-Identifier: Apache-2.0
#include "core/outline/moments.h"

#include "core/base/det_math.h"

namespace nt {

Moments polygon_moments(std::span<const Vec2> contour) {
  Moments m;
  const std::size_t n = contour.size();
  if (n < 3) return m;
  // Relative to the first point, so that the sums stay small.
  const Vec2 origin = contour[0];
  double a = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = contour[i] - origin, q = contour[(i + 1) % n] - origin;
    const double px = p.x, py = p.y, qx = q.x, qy = q.y;
    const double z = px * qy - qx * py;
    a += z;
    sx += (px + qx) * z;
    sy += (py + qy) * z;
    sxx += (px * px + px * qx + qx * qx) * z;
    syy += (py * py + py * qy + qy * qy) * z;
    sxy += (px * qy + 2 * px * py + 2 * qx * qy + qx * py) * z;
  }
  m.area = static_cast<float>(0.5 * a);
  if (a == 0) return m;
  const double cx = sx / (3 * a), cy = sy / (3 * a);
  m.centroid = origin + Vec2{static_cast<float>(cx), static_cast<float>(cy)};
  const double xx = sxx / (6 * a) - cx * cx, yy = syy / (6 * a) - cy * cy, xy = sxy / (12 * a) - cx * cy;
  const double half = det::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy), mean = 0.5 * (xx + yy);
  m.major = static_cast<float>(det::sqrt(mean + half > 0 ? mean + half : 0));
  m.minor = static_cast<float>(det::sqrt(mean - half > 0 ? mean - half : 0));
  const float angle = 0.5f * det::atan2(static_cast<float>(2 * xy), static_cast<float>(xx - yy));
  const det::SinCos sc = det::sincos(angle);
  m.axis = {sc.cos, sc.sin};
  return m;
}

bool encloses(std::span<const Vec2> contour, Vec2 p) {
  bool inside = false;
  const std::size_t n = contour.size();
  for (std::size_t i = 0; i < n; ++i) {  // edges that a ray to the right crosses
    const Vec2 a = contour[i], b = contour[i + 1 < n ? i + 1 : 0];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

float polygon_area(std::span<const Vec2> contour) {
  const std::size_t n = contour.size();
  double twice = 0;
  for (std::size_t i = 0; i < n; ++i)
    twice += static_cast<double>(cross(contour[i] - contour[0], contour[(i + 1) % n] - contour[0]));
  return static_cast<float>(0.5 * twice);
}

}  // namespace nt
