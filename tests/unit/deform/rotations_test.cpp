// SPDX-License-Identifier: Apache-2.0
#include "core/deform/rotations.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace nt {
namespace {

Vec3 random_vector(Random& r) { return {r.unit() - 0.5f, r.unit() - 0.5f, r.unit() - 0.5f}; }
Quat random_turn(Random& r, float most) {
  return from_rotation_vector(normalised(random_vector(r)) * (most * r.unit()));
}

// S of random edges that were turned by q and then moved a little.
void scatter(Random& r, Quat q, float noise, float s[9]) {
  for (int k = 0; k < 9; ++k) s[k] = 0.0f;
  for (int e = 0; e < 12; ++e) {
    const Vec3 rest = random_vector(r), moved = rotate(q, rest) + noise * random_vector(r);
    const float a[3] = {rest.x, rest.y, rest.z}, b[3] = {moved.x, moved.y, moved.z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s[3 * i + j] += a[i] * b[j];
    }
  }
}

float gain(const float s[9], Quat q) {  // tr(R S)
  const Vec3 columns[3] = {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})};
  float sum = 0.0f;
  for (int i = 0; i < 3; ++i) sum += dot(columns[i], Vec3{s[3 * i], s[3 * i + 1], s[3 * i + 2]});
  return sum;
}

float angle_between(Quat a, Quat b) { return length(rotation_vector(conjugate(a) * b)); }

TEST(RotationsTest, ExactScatterGivesItsRotation) {
  Random r(1);
  for (int k = 0; k < 500; ++k) {
    const Quat q = random_turn(r, 3.1f);
    float s[9];
    scatter(r, q, 0.0f, s);
    EXPECT_LT(angle_between(best_rotation(s), q), 1e-3f);
  }
}

TEST(RotationsTest, NothingNearbyIsBetter) {
  Random r(2);
  for (int k = 0; k < 500; ++k) {
    float s[9];
    if (k % 2 == 0) {
      scatter(r, random_turn(r, 3.0f), 1.0f, s);
    } else {
      for (float& v : s) v = r.unit() - 0.5f;  // half of these are reflections
    }
    const Quat q = best_rotation(s);
    EXPECT_NEAR(dot(q, q), 1.0f, 1e-5f);
    for (int t = 0; t < 30; ++t) EXPECT_LE(gain(s, random_turn(r, t < 10 ? 3.1f : 0.1f) * q), gain(s, q) + 1e-4f);
  }
}

TEST(RotationsTest, TwoNewtonStepsAgreeWithTheClosedForm) {
  Random r(3);
  int doubtful = 0;
  for (int k = 0; k < 500; ++k) {
    Matrix4x m;
    Quat4 start;
    Quat expected[4];
    for (int lane = 0; lane < 4; ++lane) {
      const Quat q = random_turn(r, 3.0f);
      float s[9];
      scatter(r, q, 0.2f, s);
      for (int i = 0; i < 9; ++i) m.m[i][lane] = s[i];
      expected[lane] = best_rotation(s);
      set_lane(start, lane, random_turn(r, 0.3f) * q);
    }
    doubtful += newton_rotations(m, 2, start);
    for (int lane = 0; lane < 4; ++lane) EXPECT_LT(angle_between(lane_of(start, lane), expected[lane]), 6e-3f);
  }
  EXPECT_LT(doubtful, 25);
}

TEST(RotationsTest, FarStartsAreToldSo) {
  Matrix4x m;
  for (int i = 0; i < 9; ++i) m.m[i] = splat4(i % 4 == 0 ? 1.0f : 0.0f);
  Quat4 start;
  for (int lane = 0; lane < 4; ++lane) set_lane(start, lane, {0, 1, 0, 0});
  EXPECT_TRUE(newton_rotations(m, 2, start));
}

}  // namespace
}  // namespace nt
