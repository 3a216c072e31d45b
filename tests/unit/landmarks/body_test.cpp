// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/det_math.h"
#include "core/outline/moments.h"
#include "tests/support/fish_outline.h"
#include "tests/support/picture.h"

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

TEST(Body, TheMoreOpaqueHalfIsTheHeads) {
  test::Picture luma(200, 40, 100), ground(200, 40, 100);
  Axis axis;
  for (int j = 0; j < kStations; ++j)
    axis.points[static_cast<std::size_t>(j)] = {20.0f + 2.0f * static_cast<float>(j), 20};
  EXPECT_NEAR(contrast_evidence(axis, luma.luma(), ground.luma()), 0, 1e-6f);
  for (int x = 20; x < 80; ++x) luma.at(x, 20) = 20;   // the front differs by 80,
  for (int x = 80; x < 150; ++x) luma.at(x, 20) = 70;  // the back by 30
  EXPECT_GT(contrast_evidence(axis, luma.luma(), ground.luma()), 0.5f);
  EXPECT_EQ(contrast_evidence(axis, {}, {}), 0) << "a drawing has no ground";
}

TEST(Body, AnAxisContinuesTheOneItLiesOn) {
  Axis axis, turned;
  std::vector<Vec2> last;
  for (int j = 0; j < kStations; ++j) {
    axis.points[static_cast<std::size_t>(j)] = {2.0f * static_cast<float>(j), 0};
    turned.points[static_cast<std::size_t>(kStations - 1 - j)] = axis.points[static_cast<std::size_t>(j)];
  }
  for (int i = 0; i < 9; ++i) last.push_back({16.0f * static_cast<float>(i) + 5, 3});
  EXPECT_GT(continuity(axis, last), 9) << "moved by six pixels";
  EXPECT_LT(continuity(turned, last), -9);
  // A closed ring lies as near to itself one way round as the other.
  Axis ring;
  for (int j = 0; j < kStations; ++j) {
    const det::SinCos a = det::sincos(2 * det::kPi * static_cast<float>(j) / kStations);
    ring.points[static_cast<std::size_t>(j)] = {40 * a.cos, 40 * a.sin};
  }
  for (std::size_t i = 0; i < 9; ++i) last[i] = ring.points[(i * 8 + 16) % kStations];
  EXPECT_LT(det::abs(continuity(ring, last)), 5) << "by a quarter turn";
}

TEST(Body, BeliefsAgreeAsProbabilitiesDo) {
  const auto share = [](float x) { return 1.0 / (1.0 + std::exp(-static_cast<double>(x))); };
  for (float a = -9; a <= 9; a += 1.5f) {
    for (float b = -9; b <= 9; b += 1.5f) {
      const double p = share(a) * share(b) + share(-a) * share(-b);
      EXPECT_NEAR(agreed(a, b), std::log(p / (1 - p)), 1e-2 + 1e-3 * det::abs(a)) << a << " " << b;
    }
  }
  EXPECT_NEAR(agreed(2, 9.2f), 2, 0.01f) << "an ordinary belief goes on nearly whole";
  EXPECT_NEAR(agreed(8, 0), 0, 1e-4f) << "and is gone after a gap";
  EXPECT_NEAR(agreed(50, -9.2f), -9.2f, 0.01f) << "what a person says is turned with the fish";
  EXPECT_NEAR(agreed(-50, -9.2f), 9.2f, 0.01f);
}

TEST(Body, AFishBentIntoARingHasItsEndsAtItsTips) {
  // 300 degrees of a ring of radius 60, 12 px thick at the head, 4 at the tail.
  std::vector<Vec2> outer, inner;
  for (int i = 0; i <= 300; ++i) {
    const det::SinCos a = det::sincos(det::kPi * static_cast<float>(i) / 180);
    const float taper = det::min(1.0f, 0.2f * static_cast<float>(i < 150 ? i : 300 - i));
    const float half = taper * (6 - 4 * static_cast<float>(i) / 300);
    outer.push_back({100 + (60 + half) * a.cos, 100 + (60 + half) * a.sin});
    inner.push_back({100 + (60 - half) * a.cos, 100 + (60 - half) * a.sin});
  }
  std::vector<Vec2> contour = outer;
  contour.insert(contour.end(), inner.rbegin() + 1, inner.rend() - 1);
  std::vector<float> arc(contour.size() + 1);
  arc_lengths(contour, arc);
  Ends tips;
  ASSERT_TRUE(find_tips(contour, arc, tips));
  Vec2 a = contour[static_cast<std::size_t>(tips.head)], b = contour[static_cast<std::size_t>(tips.tail)];
  if (length(b - outer.front()) < length(a - outer.front())) std::swap(a, b);
  EXPECT_LT(length(a - outer.front()), 8);
  EXPECT_LT(length(b - outer.back()), 8);
}

TEST(Body, ADiscHasNoTips) {
  std::vector<Vec2> contour;
  for (int i = 0; i < 360; ++i) {
    const det::SinCos a = det::sincos(det::kPi * static_cast<float>(i) / 180);
    contour.push_back({100 + 50 * a.cos, 100 + 50 * a.sin});
  }
  std::vector<float> arc(contour.size() + 1);
  arc_lengths(contour, arc);
  Ends tips;
  EXPECT_FALSE(find_tips(contour, arc, tips));
}

}  // namespace
}  // namespace nt
