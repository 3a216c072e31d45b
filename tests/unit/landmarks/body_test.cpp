// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/body.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/outline/moments.h"
#include "tests/support/fish_outline.h"

namespace nt {
namespace {

using test::FishOutline;
using test::FishShape;

struct Measured {
  explicit Measured(const FishShape& shape) : fish(shape), arc(fish.contour().size() + 1) {
    arc_lengths(fish.contour(), arc);
    centre = polygon_moments(fish.contour()).centroid;
  }
  Vec2 at(int i) const { return fish.contour()[static_cast<std::size_t>(i)]; }
  FishOutline fish;
  std::vector<float> arc;
  Vec2 centre;
};

TEST(Body, TheEndsAreTheFarthestPointsOfBothHalves) {
  const Measured m(FishShape{.bend = 0.5f});
  const Ends ends = find_ends(m.fish.contour(), m.arc, m.centre);
  Vec2 a = m.at(ends.head), b = m.at(ends.tail);
  if (length(a - m.fish.head()) > length(b - m.fish.head())) std::swap(a, b);
  EXPECT_LT(length(a - m.fish.head()), 3);
  EXPECT_LT(length(b - m.fish.tail()), 3);
}

TEST(Body, AnOpenFinIsNoEnd) {
  const Measured m(FishShape{.bend = 0.0f, .left_fin = true, .right_fin = true});
  const Ends ends = find_ends(m.fish.contour(), m.arc, m.centre);
  EXPECT_GT(length(m.at(ends.head) - m.at(ends.tail)), 0.97f * m.fish.axis_length());
}

TEST(Body, BetweenTwoTipsLiesTheNotchAndARoundTailHasNone) {
  for (const bool forked : {true, false}) {
    const Measured m(FishShape{.bend = 0.4f, .forked = forked});
    const Ends ends = find_ends(m.fish.contour(), m.arc, m.centre);
    const int tail =
        length(m.at(ends.head) - m.fish.head()) < length(m.at(ends.tail) - m.fish.head()) ? ends.tail : ends.head;
    const int notch = notch_of_tail(m.fish.contour(), m.arc, m.centre, tail);
    EXPECT_EQ(notch != tail, forked);
    EXPECT_LT(length(m.at(notch) - m.fish.tail()), 4);
  }
}

// A straight axis along x, head at 0, with the given widths of both ends.
float evidence(float front, float back, Vec2 travel) {
  std::vector<Vec2> smooth(2 * kStations);
  Axis axis;
  axis.length = 128;
  for (int j = 0; j < kStations; ++j) {
    const float x = 2.0f * static_cast<float>(j), w = front + (back - front) * static_cast<float>(j) / (kStations - 1);
    axis.points[static_cast<std::size_t>(j)] = {x, 0};
    smooth[static_cast<std::size_t>(j)] = {x, -w};
    smooth[static_cast<std::size_t>(2 * kStations - 1 - j)] = {x, w};
  }
  return order_evidence(smooth, axis, travel);
}

TEST(Body, TheWiderHalfIsTheHeads) {
  EXPECT_GT(evidence(12, 6, {}), 0.5f);
  EXPECT_LT(evidence(6, 12, {}), -0.5f);
  EXPECT_NEAR(evidence(9, 9, {}), 0, 1e-5f);
  EXPECT_NEAR(evidence(12, 6, {}), -evidence(6, 12, {}), 1e-4f);
}

TEST(Body, TravelDecidesWhereTheShapeSaysNothing) {
  EXPECT_GT(evidence(9, 9, {-10, 0}), 1) << "the head is at x = 0, so -x is ahead";
  EXPECT_LT(evidence(9, 9, {10, 0}), -1);
  EXPECT_NEAR(evidence(9, 9, {0, 10}), 0, 1e-5f) << "drifting sideways says nothing";
  EXPECT_LE(evidence(9, 9, {-1000, 0}), 1.5f) << "and no jump says everything";
}

TEST(Body, ACarriedBeliefFadesAndIsBounded) {
  EXPECT_NEAR(carried_belief(0), 0, 1e-4f);
  float last = -100;
  for (float belief = -12; belief <= 12; belief += 0.5f) {
    const float carried = carried_belief(belief);
    EXPECT_LE(det::abs(carried), det::abs(belief) + 1e-3f);
    EXPECT_LE(det::abs(carried), 9.3f);
    EXPECT_GE(carried, last);
    last = carried;
  }
  EXPECT_NEAR(carried_belief(2), 2, 0.01f) << "an ordinary belief goes on nearly whole";
}

}  // namespace
}  // namespace nt
