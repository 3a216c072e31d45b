// SPDX-License-Identifier: Apache-2.0
#include "core/deform/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

LatticeSettings plain_settings() {
  LatticeSettings s;
  s.max_iterations = 50;
  s.accelerate = s.extrapolate = false;
  return s;
}
LatticeSettings converged_settings() {
  LatticeSettings s;
  s.max_iterations = 100;
  s.tolerance = 1e-8f;
  return s;
}

TEST(LatticeTest, MemoryIsWhatWasCounted) {
  const LatticeData small = small_bar(), large = bar(40, 3, 4, 8), thick = large_bar();
  ASSERT_GE(small.vertices.size(), 430u);
  ASSERT_GE(large.vertices.size(), 1000u);
  ASSERT_GE(thick.vertices.size(), 1000u);
  Solver solver(small);
  EXPECT_EQ(solver.bytes(), solver.used());
  EXPECT_LE(Lattice::bytes_needed(small.view()), 256u * 1024u);
  EXPECT_LE(Lattice::bytes_needed(large.view()), 640u * 1024u);
  EXPECT_LE(Lattice::bytes_needed(thick.view()), 640u * 1024u);
}

TEST(LatticeTest, TooLittleMemoryIsAnError) {
  const LatticeData data = bar(4, 1, 2, 2);
  const std::size_t bytes = Lattice::bytes_needed(data.view());
  for (const std::size_t size : {std::size_t{0}, std::size_t{64}, bytes / 2, bytes - 64}) {
    Block block(size);
    Arena arena(block.span());
    EXPECT_FALSE(Lattice::create(arena, data.view(), {}).ok()) << size;
  }
}

TEST(LatticeTest, RigidMarkersMoveItRigidly) {
  const LatticeData data = small_bar();
  Solver solver(data);
  const Quat turn = normalised(Quat{0.2f, -0.7f, 0.5f, 0.4f});
  const Vec3 shift{100, -50, 20};
  auto markers = rest_markers(solver.view());
  for (Vec3& m : markers) m = rotate(turn, m) + shift;
  EXPECT_LT(solver.step(markers).residual, 1e-6f);
  for (std::size_t i = 0; i < data.vertices.size(); ++i) {
    EXPECT_LT(length(solver->vertices()[i] - (rotate(turn, data.vertices[i]) + shift)), 1e-3f);
  }
  const LatticeQuality q = solver->quality();
  EXPECT_LT(q.rrms, 1e-3f);
  EXPECT_EQ(q.inverted, 0);
}

TEST(LatticeTest, StopsWhenItHasConverged) {
  const LatticeData data = small_bar();
  LatticeSettings settings = converged_settings();
  settings.tolerance = 1e-6f;
  Solver solver(data, settings);
  const LatticeReport report = solver.step(bent_markers(solver.view(), 0.08f));
  EXPECT_LT(report.iterations, 60);
  EXPECT_LT(report.residual, 1e-6f);
  EXPECT_GT(report.iterations, 3);
  EXPECT_EQ(solver->quality().inverted, 0);
}

// METHOD fact 6: ten iterations of ours are as near to the pose they head for as fifty plain ones.
class AccelerationTest : public testing::TestWithParam<int> {};

std::vector<Vec3> sway_markers(const LatticeView& view, int motion, int frame, Random& random) {
  constexpr float kHz[] = {0.0f, 2.0f, 2.0f};
  const float t = static_cast<float>(frame) / (motion == 2 ? 100.0f : 30.0f);
  const float k = motion == 0 ? 0.001f * static_cast<float>(frame) : 0.04f * det::sin(det::kTwoPi * kHz[motion] * t);
  auto markers = bent_markers(view, k);
  if (motion == 2) {
    for (Vec3& m : markers) m += Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f} * 0.02f;
  }
  return markers;
}

TEST_P(AccelerationTest, TenStepsReachWhatFiftyPlainOnesDo) {
  const LatticeData data = bar(24, 3, 3, 12);
  LatticeSettings fast;
  Solver ours(data, fast), plain(data, plain_settings()), goal(data, converged_settings());
  Random random(3);
  double our_sum = 0.0, plain_sum = 0.0;
  for (int f = 0; f < 40; ++f) {
    const auto markers = sway_markers(ours.view(), GetParam(), f, random);
    ours.step(markers), plain.step(markers), goal.step(markers);
    if (f < 4) continue;
    our_sum += rms_step(ours->vertices(), goal->vertices());
    plain_sum += rms_step(plain->vertices(), goal->vertices());
  }
  EXPECT_LE(our_sum, plain_sum);
  EXPECT_LT(our_sum / 36.0, 1e-4 * 24.0);
}

INSTANTIATE_TEST_SUITE_P(Motions, AccelerationTest, testing::Values(0, 1, 2));

TEST(LatticeTest, BoneLengthsAreExactAndJointsStayWithinTheirLimits) {
  JointLimits limits;
  limits.twist_min = -0.2f, limits.twist_max = 0.3f;
  limits.y_min = -0.1f, limits.y_max = 0.6f;
  limits.z_min = -0.4f, limits.z_max = 0.2f;
  const LatticeData data = bar(12, 1, 4, 3, limits);
  Solver solver(data);
  const SkeletonView& s = solver.view().skeleton;
  constexpr float kSlack = 0.5f * det::kPi / 180.0f;
  Random random(11);
  float worst_length = 0.0f, worst_angle = 0.0f;
  int at_limit = 0;
  for (int pose = 0; pose < 10000; ++pose) {
    auto markers = bent_markers(solver.view(), 0.6f * (random.unit() - 0.5f));
    for (Vec3& m : markers) m += Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f} * 2.0f;
    if (pose % 50 == 0) solver->reset();
    solver.step(markers);
    worst_length = det::max(worst_length, solver->quality().bone_error_max);
    for (std::size_t j = 1; j < s.joints(); ++j) {
      const JointAngles a = solver->skeleton().angles(j);
      const float over = std::max({a.twist - limits.twist_max, limits.twist_min - a.twist, a.y - limits.y_max,
                                   limits.y_min - a.y, a.z - limits.z_max, limits.z_min - a.z});
      worst_angle = det::max(worst_angle, over);
      at_limit += over > -1e-4f;
      // The bones in the result point where these rotations say.
      const auto place = [&](uint16_t v) { return solver->vertices()[v]; };
      const Vec3 along = normalised(place(s.vertex[j]) - place(s.vertex[s.parent[j]]));
      EXPECT_LT(length(along - rotate(solver->bone_rotations()[j], Vec3{1, 0, 0})), 2e-4f);
    }
  }
  EXPECT_GT(at_limit, 10000) << "the limits were hardly tried";
  EXPECT_LT(worst_length, 1e-3f);
  EXPECT_LT(worst_angle, kSlack);
}

// Every third marker goes and comes back; then all of them go for 60 frames while the body moves on.
TEST(LatticeTest, MarkersThatGoAndComeBackMakeNoJump) {
  const LatticeData data = small_bar();
  Solver solver(data);
  const std::size_t count = solver.view().markers.size();
  std::vector<uint8_t> seen(count, 1);
  std::vector<Vec3> last(data.vertices.size());
  float worst = 0.0f, usual = 0.0f;
  for (int f = 0; f < 300; ++f) {
    const bool gap = f >= 100 && f < 160, all_gone = f >= 200 && f < 260;
    for (std::size_t m = 0; m < count; ++m) seen[m] = !(all_gone || (gap && m % 3 == 0));
    auto markers = bent_markers(solver.view(), 0.05f * det::sin(0.05f * static_cast<float>(f)));
    for (Vec3& p : markers) p += Vec3{0.02f * static_cast<float>(f), 0, 0};
    if (f % 7 == 0 && gap) markers[0].x = std::numeric_limits<float>::quiet_NaN();
    const LatticeReport report = solver->step(markers, seen);
    EXPECT_EQ(report.held, all_gone);
    const float step = f == 0 ? 0.0f : largest_step(solver->vertices(), last);
    (f < 100 ? usual : worst) = det::max(f < 100 ? usual : worst, step);
    std::copy(solver->vertices().begin(), solver->vertices().end(), last.begin());
  }
  // The 60 frames' way of its ends, up to 12, is caught up over the blend: half a unit a frame.
  EXPECT_LT(usual, 0.4f);
  EXPECT_LT(worst, 0.7f);
  // And nothing of it is left: the same markers from the start give the same pose.
  Solver fresh(data, converged_settings());
  auto markers = bent_markers(solver.view(), 0.05f * det::sin(0.05f * 299.0f));
  for (Vec3& p : markers) p += Vec3{0.02f * 299.0f, 0, 0};
  fresh.step(markers);
  EXPECT_LT(largest_step(solver->vertices(), fresh->vertices()), 0.02f);
}

TEST(LatticeTest, NoMarkersAtAllHoldsTheRestPose) {
  const LatticeData data = small_bar();
  Solver solver(data);
  const std::vector<uint8_t> none(solver.view().markers.size(), 0);
  EXPECT_TRUE(solver->step(rest_markers(solver.view()), none).held);
  EXPECT_EQ(largest_step(solver->vertices(), data.vertices), 0.0f);
}

TEST(LatticeTest, WildMarkersStayFinite) {
  const LatticeData data = bar(8, 1, 2, 4);
  Solver solver(data);
  Random random(5);
  for (int pose = 0; pose < 500; ++pose) {
    auto markers = rest_markers(solver.view());
    const float far = pose % 3 == 0 ? 1000.0f : 20.0f;
    for (Vec3& m : markers) {
      m = Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f} * (pose % 7 == 0 ? 0.0f : far);
    }
    solver.step(markers);
    for (const Vec3 p : solver->vertices()) ASSERT_LT(length(p), 1e5f) << pose;
  }
}

TEST(LatticeTest, OneMarkerCarriesTheWholeLattice) {
  const LatticeData data = small_bar();
  Solver solver(data);
  std::vector<uint8_t> one(solver.view().markers.size(), 0);
  one[2] = 1;
  auto markers = rest_markers(solver.view());
  for (Vec3& m : markers) m += Vec3{5, 6, 7};
  EXPECT_FALSE(solver->step(markers, one).singular);
  EXPECT_NEAR(length(solver->vertices()[solver.view().markers[2].vertex[0]] - markers[2]), 0.0f, 1e-3f);
}

}  // namespace
}  // namespace nt::test
