// SPDX-License-Identifier: Apache-2.0
#include "app/take/property_group.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

void add_bones(std::vector<MotionProperty>& list, Kind kind, int count) {
  for (int i = 0; i < count; ++i) list.push_back({kind, i});
}

}  // namespace

std::vector<MotionProperty> properties_of(const std::string& word) {
  std::vector<MotionProperty> list;
  MotionProperty one;
  if (parse_property(word.c_str(), one)) return {one};
  if (word == "up_axis" || word == "body") add_bones(list, Kind::up_axis, kMaxUpAxis);
  if (word == "low_axis" || word == "body") add_bones(list, Kind::low_axis, kMaxLowAxis);
  if (word == "body") list.insert(list.end(), {{Kind::head, 0}, {Kind::tail, 0}});
  if (word == "fins") list = {{Kind::l_fin, 0}, {Kind::r_fin, 0}};
  if (word == "path") list = {{Kind::dir, 0}, {Kind::centre_x, 0}, {Kind::centre_y, 0}};
  return list;
}

std::vector<std::string> property_words() {
  std::vector<std::string> words{"up_axis", "low_axis", "body", "fins", "path"};
  const Motion motion;
  for (int kind = 0; kind <= static_cast<int>(Kind::centre_y); ++kind) {
    for (int i = 0; i < kMaxLowAxis; ++i) {
      const MotionProperty property{static_cast<Kind>(kind), i};
      const bool bone = property.kind == Kind::up_axis || property.kind == Kind::low_axis;
      if (!has(motion, property) || (i > 0 && !bone)) break;
      char text[kPropertyNameSize];
      property_name(property, text);
      words.emplace_back(text);
    }
  }
  return words;
}

}  // namespace nt
