// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/puppet.h"

#include <gtest/gtest.h>

#include "app/author/picture_character.h"
#include "tests/app/swimming_motion.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

using Kind = MotionProperty::Kind;

const FigureView kView{1.5f, {500, 200}, {300, 150}, false};

const Wardrobe& carp() {
  static const Wardrobe wardrobe({NEONTETRA_ASSETS "/characters/carp.png"}, std::nullopt);
  return wardrobe;
}

Vec2 handle_of(const Puppet& puppet, MotionProperty property) {
  for (const Handle& handle : puppet.handles())
    if (handle.property == property) return handle.at;
  ADD_FAILURE() << "no such handle";
  return {};
}

Motion moment() {
  Motion motion = swimming(46)[45];
  motion.dir_rad = 0.7f;
  motion.l_fin_angle = -2.5f;  // half open
  return motion;
}

TEST(Puppet, LiesWhereTheFishIsAndAsLongAsIt) {
  Puppet puppet(carp(), 180);
  Motion straight = straight_motion(3, 15);
  straight.centre = {480, 220};
  puppet.pose(straight, kView);
  const Vec2 centre = handle_of(puppet, {Kind::centre_x, 0});
  EXPECT_NEAR(length(centre - kView.to_scene({480, 220})), 0, 0.01);
  const float long_px = length(handle_of(puppet, {Kind::head, 0}) - handle_of(puppet, {Kind::tail, 0}));
  EXPECT_NEAR(long_px, 180 * 1.5f, 0.12f * 180 * 1.5f);  // drawn with a bend, measured straight
}

TEST(Puppet, AHandleComesToWhereItIsPulled) {
  Puppet puppet(carp(), 180);
  for (const MotionProperty property : {MotionProperty{Kind::tail, 0},
                                        {Kind::head, 0},
                                        {Kind::low_axis, 4},
                                        {Kind::up_axis, 1},
                                        {Kind::low_axis, 14},
                                        {Kind::l_fin, 0},
                                        {Kind::dir, 0}}) {
    for (const float by : {-0.15f, 0.2f}) {
      Motion there = moment();
      set_value(there, property, value_of(there, property) + by);
      puppet.pose(there, kView);
      const Vec2 to = handle_of(puppet, property);
      const float value = puppet.value_for(moment(), property, to, kView);
      EXPECT_NEAR(value, value_of(there, property), 2e-3) << static_cast<int>(property.kind) << " " << by;
    }
  }
}

TEST(Puppet, WhereItCannotGoItComesAsNearAsItCan) {
  Puppet puppet(carp(), 180);
  const MotionProperty fin{Kind::l_fin, 0};
  Motion open = moment();
  open.l_fin_angle = -4.2f;  // farther than any fin opens: the drawing's stands still there
  puppet.pose(moment(), kView);
  const Vec2 folded = handle_of(puppet, fin);
  const float value = puppet.value_for(open, fin, folded, kView);
  open.l_fin_angle = value;
  puppet.pose(open, kView);
  EXPECT_LT(length(handle_of(puppet, fin) - folded), 6);
}

TEST(Puppet, AFinAtItsLimitIsNotPulledBeyondIt) {
  Puppet puppet(carp(), 180);
  const MotionProperty fin{Kind::l_fin, 0};
  Motion folded = straight_motion(3, 15);
  puppet.pose(folded, kView);
  const Vec2 root = puppet.posed().control_points().fins[kLeftFin].bottom, tip = handle_of(puppet, fin);
  const float value = puppet.value_for(folded, fin, tip + (tip - root) * 0.1f, kView);
  EXPECT_NEAR(value, folded.l_fin_angle, 0.2f);
}

TEST(Puppet, AFrameLooksTheSameHoweverItIsComeTo) {
  Puppet one(carp(), 180), other(carp(), 180);
  for (const Motion& motion : swimming(30)) one.pose(motion, kView);
  one.pose(moment(), kView);
  other.pose(moment(), kView);
  for (std::size_t i = 0; i < one.posed().vertices().size(); ++i)
    ASSERT_EQ(length(one.posed().vertices()[i] - other.posed().vertices()[i]), 0) << i;
}

}  // namespace
}  // namespace nt
