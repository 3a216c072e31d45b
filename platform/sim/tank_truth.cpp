// SPDX-License-Identifier: Apache-2.0
// The attributes of [F] Table 1 measured on the simulated fish's own shape.
#include "core/base/det_math.h"
#include "platform/sim/tank_fish.h"

namespace nt::tank {
namespace {

struct Area {
  Vec2 barycentre;
  Vec2 axis;  // unit, of the largest second moment; its sign is arbitrary
};

// Area moments of a polygon by Green's theorem, about its first point so that floats keep their digits.
Area area_of(const std::vector<Vec2>& polygon) {
  double area = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  const Vec2 origin = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - origin, b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - origin;
    const double ax = a.x, ay = a.y, bx = b.x, by = b.y;
    const double c = ax * by - bx * ay;
    area += c / 2;
    sx += c * (ax + bx) / 6;
    sy += c * (ay + by) / 6;
    sxx += c * (ax * ax + ax * bx + bx * bx) / 12;
    syy += c * (ay * ay + ay * by + by * by) / 12;
    sxy += c * (ax * by + 2 * ax * ay + 2 * bx * by + bx * ay) / 24;
  }
  const double mx = sx / area, my = sy / area;
  const double cxx = sxx / area - mx * mx, cyy = syy / area - my * my, cxy = sxy / area - mx * my;
  const float angle = 0.5f * det::atan2(static_cast<float>(2 * cxy), static_cast<float>(cxx - cyy));
  const det::SinCos d = det::sincos(angle);
  return {origin + Vec2{static_cast<float>(mx), static_cast<float>(my)}, {d.cos, d.sin}};
}

// s of the midline point nearest to p.
float nearest_s(std::span<const Vec2> line, Vec2 p) {
  float best = 1e30f, best_s = 0.0f;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 along = line[i + 1] - line[i];
    const float t = det::clamp(dot(p - line[i], along) / length_sq(along), 0.0f, 1.0f);
    const float d = length_sq(p - (line[i] + along * t));
    if (d >= best) continue;
    best = d;
    best_s = (static_cast<float>(i) + t) / static_cast<float>(line.size() - 1);
  }
  return best_s;
}

// Scored when it is plainly out, not scored when it is folded or a sliver.
float fin_confidence(const FinShape& fin) {
  if (fin.stands_out > 0.03f) return 1.0f;
  return fin.stands_out >= 0.015f ? 0.5f : 0.0f;
}

PoseStatus status_of(const std::vector<Vec2>& contour, int width, int height) {
  bool all_in = true, any_in = false;
  const float right = static_cast<float>(width - 1), bottom = static_cast<float>(height - 1);
  for (Vec2 p : contour) {
    any_in = any_in || (p.x >= -0.5f && p.y >= -0.5f && p.x <= right + 0.5f && p.y <= bottom + 0.5f);
    all_in = all_in && p.x >= 2.0f && p.y >= 2.0f && p.x <= right - 2.0f && p.y <= bottom - 2.0f;
  }
  return all_in ? PoseStatus::ok : any_in ? PoseStatus::partial : PoseStatus::absent;
}

}  // namespace

void fill_pose(const FishShape& shape, int width, int height, FishPose& pose) {
  pose = {};
  pose.status = status_of(shape.contour, width, height);
  const Area area = area_of(shape.contour);
  const float centre_s = nearest_s(shape.midline(), area.barycentre);
  pose.centre = shape.at(centre_s);
  pose.head = shape.at(0.0f);
  pose.tail = shape.at(1.0f);
  pose.dir = dot(area.axis, pose.head - pose.tail) < 0.0f ? area.axis * -1.0f : area.axis;
  for (int i = 0; i < pose.u_num; ++i)
    pose.up_axis[i] = shape.at(centre_s * (1.0f - static_cast<float>(i + 1) / static_cast<float>(pose.u_num + 1)));
  for (int i = 0; i < pose.l_num; ++i)
    pose.low_axis[i] =
        shape.at(centre_s + (1.0f - centre_s) * static_cast<float>(i + 1) / static_cast<float>(pose.l_num + 1));
  const FinShape &left = shape.fin[kLeft], &right = shape.fin[kRight];
  pose.l_fin = left.tip;
  pose.r_fin = right.tip;
  pose.jun_tl = left.front;
  pose.jun_bl = left.rear;
  pose.jun_tr = right.front;
  pose.jun_br = right.rear;
  pose.axis_len = shape.length_px;
  if (!pose.ok()) return;
  pose.confidence = {1, 1, 1, fin_confidence(left), fin_confidence(right), 1};
}

}  // namespace nt::tank
