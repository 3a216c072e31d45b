// SPDX-License-Identifier: Apache-2.0
#include "core/motion/property.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

std::string name_of(MotionProperty property) {
  char text[kPropertyNameSize];
  property_name(property, text);
  return text;
}

TEST(Property, NamesAreReadBackAsWritten) {
  std::set<std::string> names;
  for (int kind = 0; kind <= static_cast<int>(Kind::centre_y); ++kind) {
    const auto k = static_cast<Kind>(kind);
    const int bones = k == Kind::up_axis ? kMaxUpAxis : k == Kind::low_axis ? kMaxLowAxis : 1;
    for (int i = 0; i < bones; ++i) {
      const std::string name = name_of({k, i});
      MotionProperty read;
      ASSERT_TRUE(parse_property(name.c_str(), read)) << name;
      EXPECT_EQ(read, (MotionProperty{k, i})) << name;
      EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
  EXPECT_EQ(name_of({Kind::up_axis, 0}), "up_axis_angle_1");
  EXPECT_EQ(name_of({Kind::low_axis, 31}), "low_axis_angle_32");
}

TEST(Property, RefusesWhatIsNoName) {
  MotionProperty property;
  for (const char* name :
       {"", "head", "head_angle_1", "up_axis_angle_", "up_axis_angle_0", "up_axis_angle_9", "up_axis_angle_01",
        "low_axis_angle_33", "low_axis_angle_1x", "low_axis_angle_-1", "Head_angle"})
    EXPECT_FALSE(parse_property(name, property)) << name;
}

TEST(Property, EachIsANumberOfItsOwn) {
  Motion m = straight_motion(3, 15);
  for (int kind = 0; kind <= static_cast<int>(Kind::centre_y); ++kind)
    set_value(m, {static_cast<Kind>(kind), 2}, 100.0f + static_cast<float>(kind));
  for (int kind = 0; kind <= static_cast<int>(Kind::centre_y); ++kind)
    EXPECT_EQ(value_of(m, {static_cast<Kind>(kind), 2}), 100.0f + static_cast<float>(kind));
  EXPECT_EQ(m.up_axis_angle[2], 100.0f);
  EXPECT_EQ(m.low_axis_angle[2], 101.0f);
  EXPECT_EQ(m.centre.y, 108.0f);
}

TEST(Property, BonesThatAMotionLacks) {
  const Motion m = straight_motion(3, 15);
  EXPECT_TRUE(has(m, {Kind::up_axis, 2}));
  EXPECT_FALSE(has(m, {Kind::up_axis, 3}));
  EXPECT_FALSE(has(m, {Kind::low_axis, 15}));
  EXPECT_TRUE(has(m, {Kind::tail, 0}));
}

}  // namespace
}  // namespace nt
