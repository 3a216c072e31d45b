// SPDX-License-Identifier: Apache-2.0
#include "core/outline/midline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/fish_outline.h"

namespace nt {
namespace {

using test::FishOutline;
using test::FishShape;

constexpr int kLast = kStations - 1;

// A fish's true axis, moved sideways by `off`, and its outline along it.
struct Scene {
  explicit Scene(const FishShape& shape, float off = 0) : fish(shape), along(fish.contour().size()) {
    std::vector<Vec2> line;
    for (int i = 0; i <= 300; ++i) line.push_back(fish.at(static_cast<float>(i) / 300, off));
    axis = resampled(line);
    int tail = 0;
    for (int i = 0; i < static_cast<int>(along.size()); ++i)
      if (length(at(i) - fish.tail()) < length(at(tail) - fish.tail())) tail = i;
    right = {0, tail};
    project_outline(fish.contour(), right, axis, along);
    widths = width_profile(along, right);
  }
  Vec2 at(int i) const { return fish.contour()[static_cast<std::size_t>(i)]; }
  FishOutline fish;
  std::vector<AlongAxis> along;
  Axis axis;
  Stretch right;
  WidthProfile widths;
};

TEST(Midline, ResampledIsUniformWhateverTheSpacing) {
  const std::vector<Vec2> line{{0, 0}, {1, 0}, {1, 0}, {1.5f, 0}, {30, 0}, {30, 34}};
  const Axis axis = resampled(line);
  EXPECT_FLOAT_EQ(axis.length, 64);
  EXPECT_EQ(axis.points[0].x, 0);
  EXPECT_EQ(axis.points[kLast].y, 34);
  EXPECT_NEAR(axis.points[10].x, 10, 1e-4f);
  EXPECT_NEAR(axis.points[40].y, 10, 1e-4f);
  EXPECT_NEAR(point_at(axis, 0.25f).x, 16, 1e-4f);
  EXPECT_NEAR(point_at(axis, 7).y, 34, 1e-4f);
  EXPECT_NEAR(tangent_at(axis, 0.9f).y, 1, 1e-5f);
  EXPECT_NEAR(tangent_at(axis, -1).x, 1, 1e-5f);
}

TEST(Midline, APointIsAnAxisOfNoLength) {
  const std::vector<Vec2> point(3, Vec2{5, 6});
  const Axis axis = resampled(point);
  EXPECT_EQ(axis.length, 0);
  for (const Vec2 p : axis.points) EXPECT_EQ(p.x, 5);
  EXPECT_EQ(length(tangent_at(axis, 0.5f)), 1) << "still a direction";
}

TEST(Midline, TheOutlineAlongTheAxisHasTheFishsWidths) {
  for (const float bend : {-0.8f, 0.0f, 0.8f}) {
    const Scene s(FishShape{.bend = bend});
    for (int j = 3; j < kLast - 3; ++j) {
      const float share = static_cast<float>(j) / kLast;
      for (const StationValues& side : s.widths.side)
        EXPECT_NEAR(side[static_cast<std::size_t>(j)], s.fish.half_width(share), 0.7f) << bend << " " << j;
    }
    for (int k = 5; k < s.right.count - 5; ++k)
      EXPECT_GT(s.along[static_cast<std::size_t>(k)].d, 0) << "right of the fish";
    for (std::size_t k = static_cast<std::size_t>(s.right.count) + 5; k + 5 < s.along.size(); ++k)
      EXPECT_LT(s.along[k].d, 0);
  }
}

TEST(Midline, TheBodyHasNoFins) {
  const Scene s(FishShape{.left_fin = true, .right_fin = true});
  const StationValues body = body_half_width(s.widths);
  EXPECT_GT(s.widths.side[0][21], s.fish.half_width(21.0f / kLast) + 15) << "the fin is in the outline";
  for (int j = 8; j < 50; ++j) {
    const float truth = s.fish.half_width(static_cast<float>(j) / kLast);
    EXPECT_NEAR(body[static_cast<std::size_t>(j)], truth, 0.35f * truth) << j;
  }
}

TEST(Midline, AnAxisBesideTheMiddleIsCentred) {
  for (const bool fin : {false, true}) {
    const Scene s(FishShape{.bend = 0.4f, .left_fin = fin}, 5);
    const Axis out = centred(s.axis, s.widths, body_half_width(s.widths));
    float sum = 0;
    for (int j = 6; j < 58; ++j) {
      const Vec2 p = out.points[static_cast<std::size_t>(j)];
      float nearest = 1e9f;
      for (int i = 0; i <= 1000; ++i)
        nearest = det::min(nearest, length(p - s.fish.at(static_cast<float>(i) / 1000, 0)));
      sum += nearest;
    }
    EXPECT_LT(sum / 52, 1.2f) << "it was 5 pixels off";
  }
}

TEST(Midline, TheAxisRunsToTheEndsOfTheOutline) {
  const Scene s(FishShape{.bend = 0.5f});
  std::vector<Vec2> part(s.axis.points.begin() + 4, s.axis.points.end() - 4);
  const Axis shorter = resampled(part);
  const AxisEnds ends{s.fish.head(), s.fish.tail()};
  for (const Axis& axis : {joined_to_ends(shorter, ends), extended_to_outline(shorter, s.fish.contour(), ends)}) {
    EXPECT_LT(length(axis.points[0] - s.fish.head()), 3);
    EXPECT_LT(length(axis.points[kLast] - s.fish.tail()), 3);
    EXPECT_NEAR(axis.length, s.fish.axis_length(), 3);
  }
}

TEST(Midline, AnAxisThatStrayedIntoALobeRunsStraightToTheNotch) {
  const std::vector<Vec2> line{{0, 0}, {76, 0}, {88, 20.8f}};  // the last part in a lobe, 60 degrees aside
  const Vec2 notch{94, -1};
  const auto sharpest_cosine = [&](bool notched) {
    const Axis axis = joined_to_ends(resampled(line), {{0, 0}, notch, 0, 0, notched});
    EXPECT_EQ(length(axis.points[kLast] - notch), 0);
    float least = 1;
    for (std::size_t j = 4; j + 4 <= kLast; ++j) {
      const Vec2 before = axis.points[j] - axis.points[j - 4], after = axis.points[j + 4] - axis.points[j];
      least = std::min(least, dot(before, after) / (length(before) * length(after)));
    }
    return least;
  };
  EXPECT_GT(sharpest_cosine(true), 0.7f);
  EXPECT_LT(sharpest_cosine(false), 0.3f) << "taken for an end without a notch, this axis hooks";
}

TEST(Midline, TheFirstAxisHalvesTheSmoothOutline) {
  const FishOutline fish(FishShape{.bend = 0.4f});
  std::vector<float> arc(fish.contour().size() + 1);
  arc_lengths(fish.contour(), arc);
  const EllipticFourier f = fit_fourier(fish.contour(), arc, 5);
  std::vector<Vec2> smooth(2 * kStations);
  const Axis axis = medial_axis(f, 0, 0.5f, smooth);
  EXPECT_LT(fish.rms_from_axis(axis.points), 0.02f);
  // Right side first, left side backwards: a station and its mirror lie on either side.
  for (std::size_t j = 10; j < 55; ++j) {
    const Vec2 across = smooth[j] - smooth[2 * kStations - 1 - j];
    EXPECT_GT(dot(across, right_of(tangent_at(axis, static_cast<float>(j) / kLast) * -1.0f)), 0) << j;
  }
}

}  // namespace
}  // namespace nt
