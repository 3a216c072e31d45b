// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/curves.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

constexpr float kDegrees = 57.29578f;

bool is_position(MotionProperty property) { return property.kind == Kind::centre_x || property.kind == Kind::centre_y; }

// Degrees a radian; the left fin's count backwards, so that both fins open upwards.
float scale_of(MotionProperty property) {
  if (is_position(property)) return 1.0f;
  return property.kind == Kind::l_fin ? -kDegrees : kDegrees;
}

// What a position or a course is counted from: itself.
float zero_of(MotionProperty property, const Motion& rest) {
  return property.is_path() ? 0.0f : value_of(rest, property);
}

}  // namespace

std::vector<NamedCurve> named_curves(const Motion& bones) {
  const int low = bones.l_num - 1;
  return {{"Course", {Kind::dir, 0}, "dir_rad"},
          {"Across", {Kind::centre_x, 0}, "centre_x"},
          {"Down", {Kind::centre_y, 0}, "centre_y"},
          {"Head", {Kind::head, 0}, "body"},
          {"Neck", {Kind::up_axis, bones.u_num / 2}, "body"},
          {"Waist", {Kind::low_axis, low / 3}, "body"},
          {"Rear", {Kind::low_axis, 2 * low / 3}, "body"},
          {"Tail root", {Kind::low_axis, low}, "body"},
          {"Tail fin", {Kind::tail, 0}, "body"},
          {"Left fin", {Kind::l_fin, 0}, "l_fin_angle"},
          {"Right fin", {Kind::r_fin, 0}, "r_fin_angle"}};
}

std::string plain_name(MotionProperty property, const std::vector<NamedCurve>& curves) {
  for (const NamedCurve& curve : curves)
    if (curve.property == property) return curve.name;
  const char* part = property.kind == Kind::up_axis ? "Head joint " : "Tail joint ";
  return part + std::to_string(property.index + 1);
}

const char* group_of(MotionProperty property) {
  for (const NamedCurve& curve : named_curves(Motion{}))
    if (curve.property.kind == property.kind) return curve.group;
  return "body";
}

float degrees_or_pixels(float value, MotionProperty property, const Motion& rest) {
  return (value - zero_of(property, rest)) * scale_of(property);
}

float from_degrees_or_pixels(float shown, MotionProperty property, const Motion& rest) {
  return zero_of(property, rest) + shown / scale_of(property);
}

const char* unit_of(MotionProperty property) { return is_position(property) ? " px" : "\u00b0"; }

float confidence_of(const Motion& motion, MotionProperty property) {
  if (motion.status != PoseStatus::ok) return 0;
  const PoseConfidence& sure = motion.confidence;
  switch (property.kind) {
    case Kind::head:
    case Kind::dir:
      return sure.head;
    case Kind::tail:
      return sure.tail;
    case Kind::l_fin:
      return sure.l_fin;
    case Kind::r_fin:
      return sure.r_fin;
    case Kind::up_axis:
    case Kind::low_axis:
      return sure.axis;
    case Kind::centre_x:
    case Kind::centre_y:
      break;
  }
  return sure.centre;
}

}  // namespace nt
