// SPDX-License-Identifier: Apache-2.0
#include "core/motion/property.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

struct Name {
  const char* text;
  Kind kind;
  int bones;  // 0: no number follows
};
constexpr Name kNames[] = {
    {"up_axis_angle_", Kind::up_axis, kMaxUpAxis},
    {"low_axis_angle_", Kind::low_axis, kMaxLowAxis},
    {"head_angle", Kind::head, 0},
    {"tail_angle", Kind::tail, 0},
    {"l_fin_angle", Kind::l_fin, 0},
    {"r_fin_angle", Kind::r_fin, 0},
    {"dir_rad", Kind::dir, 0},
    {"centre_x", Kind::centre_x, 0},
    {"centre_y", Kind::centre_y, 0},
};

// 1 .. largest, without leading zeros; 0 when it is not that.
int parse_number(const char* text, int largest) {
  if (*text == '0') return 0;
  int value = 0;
  for (const char* c = text; *c != 0; ++c) {
    if (*c < '0' || *c > '9') return 0;
    value = value * 10 + (*c - '0');
    if (value > largest) return 0;
  }
  return value;
}

// What follows `prefix` in `text`; null when it does not begin so.
const char* after(const char* prefix, const char* text) {
  for (; *prefix != 0; ++prefix, ++text)
    if (*prefix != *text) return nullptr;
  return text;
}

// The motion's own number; one function for reading and writing.
template <typename M>
auto* place(M& m, MotionProperty property) {
  switch (property.kind) {
    case Kind::up_axis:
      return &m.up_axis_angle[property.index];
    case Kind::low_axis:
      return &m.low_axis_angle[property.index];
    case Kind::head:
      return &m.head_angle;
    case Kind::tail:
      return &m.tail_angle;
    case Kind::l_fin:
      return &m.l_fin_angle;
    case Kind::r_fin:
      return &m.r_fin_angle;
    case Kind::dir:
      return &m.dir_rad;
    case Kind::centre_x:
      return &m.centre.x;
    case Kind::centre_y:
      break;
  }
  return &m.centre.y;
}

}  // namespace

bool has(const Motion& motion, MotionProperty property) {
  if (property.kind == Kind::up_axis) return property.index >= 0 && property.index < motion.u_num;
  if (property.kind == Kind::low_axis) return property.index >= 0 && property.index < motion.l_num;
  return true;
}

float value_of(const Motion& motion, MotionProperty property) { return *place(motion, property); }
void set_value(Motion& motion, MotionProperty property, float value) { *place(motion, property) = value; }

bool parse_property(const char* name, MotionProperty& property) {
  for (const Name& known : kNames) {
    const char* rest = after(known.text, name);
    if (rest == nullptr) continue;
    const int number = known.bones > 0 ? parse_number(rest, known.bones) : 1;
    if (number == 0 || (known.bones == 0 && *rest != 0)) return false;
    property = {known.kind, number - 1};
    return true;
  }
  return false;
}

void property_name(MotionProperty property, char (&text)[kPropertyNameSize]) {
  const Name& name = kNames[static_cast<int>(property.kind)];
  char* end = text;
  for (const char* c = name.text; *c != 0; ++c) *end++ = *c;
  if (name.bones > 0) {
    const int number = property.index + 1;
    if (number >= 10) *end++ = static_cast<char>('0' + number / 10);
    *end++ = static_cast<char>('0' + number % 10);
  }
  *end = 0;
}

Motion straight_motion(int u_num, int l_num) {
  Motion m;
  m.u_num = u_num, m.l_num = l_num;
  m.head_angle = det::kHalfPi, m.tail_angle = -det::kHalfPi;
  m.l_fin_angle = kFoldedLeftFin, m.r_fin_angle = kFoldedRightFin;
  for (float& angle : m.up_axis_angle) angle = det::kHalfPi;
  for (float& angle : m.low_axis_angle) angle = -det::kHalfPi;
  return m;
}

}  // namespace nt
