// SPDX-License-Identifier: Apache-2.0
#include "core/deform/skeleton.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/block.h"

namespace nt {
namespace {

// An arm along x: root, elbow at 2, hand at 4, an edge every 1.
struct Arm {
  std::vector<Vec3> rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  std::vector<uint16_t> vertex = {0, 2, 4}, parent = {kNoJoint, 0, 1}, chain = {0, 1, 2, 2, 3, 4};
  std::vector<uint32_t> start = {0, 0, 3, 6};
  std::vector<JointLimits> limits{3};
  test::Block block{65536};
  Skeleton skeleton;
  void create() {
    Arena arena(block.span());
    skeleton.create(arena, {vertex, parent, start, chain, limits}, rest);
  }
  std::vector<float> packed(const std::vector<Vec3>& x) {
    std::vector<float> out;
    for (const Vec3 p : x) out.insert(out.end(), {p.x, p.y, p.z});
    out.resize(out.size() + 4);
    return out;
  }
  std::vector<Quat4> unturned() {
    return std::vector<Quat4>(2, Quat4{splat4(1.0f), splat4(0.0f), splat4(0.0f), splat4(0.0f)});
  }
};

TEST(SkeletonTest, BonesAreStraightAndKeepTheirLength) {
  Arm arm;
  arm.create();
  auto x = arm.packed({{0, 0, 0}, {1.5f, 0.2f, 0}, {2.5f, 0, 0}, {2.6f, 0.4f, 0.3f}, {2.5f, 1.8f, 0}});
  arm.skeleton.project(x.data(), arm.unturned());
  arm.skeleton.place(x.data());
  const auto at = [&](int i) { return Vec3{x[3 * i], x[3 * i + 1], x[3 * i + 2]}; };
  for (int i = 1; i < 5; ++i) EXPECT_NEAR(length(at(i) - at(i - 1)), 1.0f, 1e-5f);
  EXPECT_NEAR(length(at(2) - at(0)), 2.0f, 1e-5f);
  EXPECT_NEAR(length(at(4) - at(2)), 2.0f, 1e-5f);
}

TEST(SkeletonTest, ABendBeyondTheLimitStopsAtIt) {
  Arm arm;
  // The frame of the second bone in line with the first: z is across, y completes it; bend in the x-y plane of the world.
  arm.limits[2].y_min = arm.limits[2].z_min = -0.5f;
  arm.limits[2].y_max = arm.limits[2].z_max = 0.5f;
  arm.create();
  for (const float bend : {0.3f, 0.5f, 0.9f, 2.0f}) {
    const det::SinCos a = det::sincos(bend);
    auto x = arm.packed({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2 + a.cos, a.sin, 0}, {2 + 2 * a.cos, 2 * a.sin, 0}});
    arm.skeleton.project(x.data(), arm.unturned());
    const JointAngles angles = arm.skeleton.angles(2);
    const float swing = det::sqrt(angles.y * angles.y + angles.z * angles.z);
    EXPECT_NEAR(swing, det::min(bend, 0.5f), 1e-4f) << bend;
    EXPECT_NEAR(angles.twist, 0.0f, 1e-4f);
    arm.skeleton.place(x.data());
    const Vec3 upper{x[6] - x[0], x[7] - x[1], x[8] - x[2]}, fore{x[12] - x[6], x[13] - x[7], x[14] - x[8]};
    EXPECT_NEAR(det::atan2(length(cross(upper, fore)), dot(upper, fore)), det::min(bend, 0.5f), 1e-3f);
  }
}

TEST(SkeletonTest, TwistComesFromTheLatticeAndIsLimited) {
  Arm arm;
  arm.limits[2].twist_min = -0.25f, arm.limits[2].twist_max = 0.25f;
  arm.create();
  auto x = arm.packed(arm.rest);
  for (const float twist : {0.1f, 1.0f, -2.0f}) {
    auto turns = arm.unturned();
    for (int v = 2; v < 5; ++v) set_lane(turns[v / 4], v % 4, from_rotation_vector({twist, 0, 0}));
    arm.skeleton.project(x.data(), turns);
    // Vertex 2 belongs to both bones, so the upper one twists by a third of it.
    EXPECT_NEAR(arm.skeleton.angles(2).twist, det::clamp(twist - twist / 3, -0.25f, 0.25f), 0.2f);
    EXPECT_LE(det::abs(arm.skeleton.angles(2).twist), 0.2501f);
  }
}

TEST(SkeletonTest, NoSkeletonIsFine) {
  Skeleton none;
  Arena measure;
  none.create(measure, {}, {});
  std::vector<float> x(4);
  none.project(x.data(), {});
  none.place(x.data());
  EXPECT_TRUE(none.rotations().empty());
}

}  // namespace
}  // namespace nt
