// SPDX-License-Identifier: Apache-2.0
#include "core/motion/inbetween.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

float lerp_angle(float a, float b, float t) { return a + det::wrap(b - a) * t; }
float lerp_value(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

Motion in_between(const Motion& from, const Motion& to, float t) {
  const bool nearer_to = t >= 0.5f;
  // Two samplings of the axis have no bones in common to go between.
  if (from.u_num != to.u_num || from.l_num != to.l_num) return nearer_to ? to : from;
  Motion m = nearer_to ? to : from;
  m.time_ns =
      from.time_ns + static_cast<int64_t>(static_cast<double>(to.time_ns - from.time_ns) * static_cast<double>(t));
  m.centre = lerp(from.centre, to.centre, t);
  m.dir_rad = lerp_angle(from.dir_rad, to.dir_rad, t);
  m.head_angle = lerp_angle(from.head_angle, to.head_angle, t);
  m.tail_angle = lerp_angle(from.tail_angle, to.tail_angle, t);
  m.l_fin_angle = lerp_angle(from.l_fin_angle, to.l_fin_angle, t);
  m.r_fin_angle = lerp_angle(from.r_fin_angle, to.r_fin_angle, t);
  for (int i = 0; i < m.u_num; ++i) m.up_axis_angle[i] = lerp_angle(from.up_axis_angle[i], to.up_axis_angle[i], t);
  for (int i = 0; i < m.l_num; ++i) m.low_axis_angle[i] = lerp_angle(from.low_axis_angle[i], to.low_axis_angle[i], t);
  m.confidence.centre = lerp_value(from.confidence.centre, to.confidence.centre, t);
  m.confidence.head = lerp_value(from.confidence.head, to.confidence.head, t);
  m.confidence.tail = lerp_value(from.confidence.tail, to.confidence.tail, t);
  m.confidence.axis = lerp_value(from.confidence.axis, to.confidence.axis, t);
  m.confidence.l_fin = lerp_value(from.confidence.l_fin, to.confidence.l_fin, t);
  m.confidence.r_fin = lerp_value(from.confidence.r_fin, to.confidence.r_fin, t);
  return m;
}

}  // namespace nt
