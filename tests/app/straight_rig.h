// SPDX-License-Identifier: Apache-2.0
// The control points of a straight figure that swims to the right: head (900, 300), centre (600, 300), tail (100, 300), one
// pair of fins with tips at (500, 300 +- 120).
#pragma once
#include <gtest/gtest.h>

#include "app/author/rig.h"

namespace nt::test {

inline Rig straight_rig(int u_num = 3, int l_num = 15) {
  Rig rig;
  rig.u_num = u_num, rig.l_num = l_num;
  rig.head = {900, 300}, rig.centre = {600, 300}, rig.tail = {100, 300};
  for (int i = 0; i < u_num; ++i)
    rig.up_axis[i] = {600 + 300 * static_cast<float>(i + 1) / static_cast<float>(u_num + 1), 300};
  for (int i = 0; i < l_num; ++i)
    rig.low_axis[i] = {600 - 500 * static_cast<float>(i + 1) / static_cast<float>(l_num + 1), 300};
  rig.fins[0] = {true, {500, 180}, {560, 250}, {520, 250}, 0.3f};
  rig.fins[1] = {true, {500, 420}, {560, 350}, {520, 350}, 0.9f};
  rig.centre_confidence = rig.head_confidence = rig.tail_confidence = 0.8f;
  set_axis_confidence(rig, 0.8f);
  return rig;
}

inline void expect_near(Vec2 got, Vec2 want, float tolerance) {
  EXPECT_NEAR(got.x, want.x, tolerance);
  EXPECT_NEAR(got.y, want.y, tolerance);
}

}  // namespace nt::test
