// SPDX-License-Identifier: Apache-2.0
#include "app/author/curve_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/author/skeleton_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

void add_box(TriangleMesh& mesh, Vec3 low, Vec3 high) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (int k = 0; k < 8; ++k) {
    mesh.positions.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  }
  const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                              2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  for (const uint32_t i : faces) mesh.triangles.push_back(first + i);
}

float nearest_joint(const SkeletonSpec& s, Vec3 p) {
  float least = 1e9f;
  for (const auto& j : s.joints) least = std::min(least, length(j.position - p));
  return least;
}

// A body with four limbs: each has its end, its bones run through its middle, and parents come first.
TEST(CurveSkeleton, ReachesEveryLimb) {
  TriangleMesh mesh;
  add_box(mesh, {-2, -2, -2}, {2, 2, 2});
  for (const float side : {-1.0f, 1.0f}) {
    add_box(mesh, {std::min(1.9f * side, 10 * side), -0.7f, -0.7f}, {std::max(1.9f * side, 10 * side), 0.7f, 0.7f});
    add_box(mesh, {-0.7f, std::min(1.9f * side, 8 * side), -0.7f}, {0.7f, std::max(1.9f * side, 8 * side), 0.7f});
  }
  const SkeletonSpec s = curve_skeleton(mesh);
  ASSERT_GE(s.joints.size(), 5u);
  EXPECT_LE(s.joints.size(), 12u);
  EXPECT_LT(length(s.joints[0].position), 1.2f);
  for (const Vec3 end : {Vec3{10, 0, 0}, Vec3{-10, 0, 0}, Vec3{0, 8, 0}, Vec3{0, -8, 0}}) {
    EXPECT_LT(nearest_joint(s, end), 1.3f);
  }
  for (std::size_t j = 1; j < s.joints.size(); ++j) EXPECT_LT(s.joints[j].parent, static_cast<int>(j));
  const BuiltLattice built = build_lattice(mesh, s, {}, {});
  EXPECT_EQ(built.data.joint_vertex.size(), s.joints.size());
}

TEST(CurveSkeleton, TextAndBack) {
  TriangleMesh mesh;
  add_box(mesh, {-4, -1, -1}, {4, 1, 1});
  SkeletonSpec s = curve_skeleton(mesh);
  s.joints.back().limits.twist_min = -0.5f;
  const SkeletonSpec back = parse_skeleton(skeleton_text(s), "text");
  ASSERT_EQ(back.joints.size(), s.joints.size());
  EXPECT_EQ(back.joints.back().parent, s.joints.back().parent);
  EXPECT_NEAR(back.joints.back().limits.twist_min, -0.5f, 1e-3f);
  EXPECT_LT(length(back.joints.back().position - s.joints.back().position), 1e-4f);
}

TEST(CurveSkeleton, NothingSolidIsOneLine) { EXPECT_THROW(curve_skeleton({}), UserError); }

}  // namespace
}  // namespace nt
