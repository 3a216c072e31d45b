// SPDX-License-Identifier: Apache-2.0
// One number of a motion, by name: what an edit sets and a curve shows.
//
// Names are those of [F] Table 2: up_axis_angle_1 .. u_num (1 next to the centre), low_axis_angle_1 .. l_num, head_angle,
// tail_angle, l_fin_angle, r_fin_angle, and beyond the paper dir_rad, centre_x, centre_y. Angles in radians, in the
// fish-local frame (motion.h); the centre in pixels.
#pragma once
#include "core/motion/motion.h"

namespace nt {

struct MotionProperty {
  enum class Kind : uint8_t { up_axis, low_axis, head, tail, l_fin, r_fin, dir, centre_x, centre_y };
  Kind kind = Kind::head;
  int index = 0;  // of up_axis and low_axis, from 0

  // Position and direction in the water: no rest pose stands behind them.
  bool is_path() const { return kind >= Kind::dir; }
  friend bool operator==(const MotionProperty&, const MotionProperty&) = default;
};

// False when the motion has no such bone.
bool has(const Motion& motion, MotionProperty property);
// The number; has() must hold.
float value_of(const Motion& motion, MotionProperty property);
void set_value(Motion& motion, MotionProperty property, float value);

// "head_angle", "low_axis_angle_15". False: no such name.
bool parse_property(const char* name, MotionProperty& property);
// Writes the name, ended by 0, to `text`.
inline constexpr int kPropertyNameSize = 24;
void property_name(MotionProperty property, char (&text)[kPropertyNameSize]);

// A straight fish with its fins folded: the rest pose M_0 where no character gives one.
Motion straight_motion(int u_num, int l_num);

}  // namespace nt
