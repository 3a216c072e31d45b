// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

constexpr int kWide = 140, kHigh = 100;
constexpr int kGround = 150;
constexpr float kLength = 80;

struct Drawing {
  float contrast = -35;     // of the line, at its front; at its end half as much
  float half_width = 0.9f;  // sigma across
  float noise = 0;          // standard deviation
  float bend = 0.02f;       // radians a pixel, from the middle on
  Vec2 head{20, 30};
  float gap_from = 0, gap_to = 0;  // pixels along the line, where it is not to be seen
  uint64_t seed = 1;
};

// A line from the head to the right, straight as far as its middle.
std::vector<Vec2> course(const Drawing& d) {
  std::vector<Vec2> line{d.head};
  float angle = 0;
  for (float walked = 0; walked < kLength; walked += 0.5f) {
    if (walked > kLength / 2) angle += 0.5f * d.bend;
    line.push_back(line.back() + Vec2{std::cos(angle), std::sin(angle)} * 0.5f);
  }
  return line;
}

test::Picture drawn(const Drawing& d) {
  test::Picture picture(kWide, kHigh, kGround);
  const std::vector<Vec2> line = course(d);
  picture.each([&](int x, int y, int ground) {
    float nearest = 1e9f;
    std::size_t at = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const float far = length_sq(line[i] - Vec2{static_cast<float>(x), static_cast<float>(y)});
      if (far < nearest) nearest = far, at = i;
    }
    const float walked = 0.5f * static_cast<float>(at);
    const bool hidden = walked > d.gap_from && walked < d.gap_to;
    const float strength = hidden ? 0 : d.contrast * (1 - 0.5f * walked / kLength);
    return static_cast<float>(ground) + strength * std::exp(-0.5f * nearest / (d.half_width * d.half_width));
  });
  Random random(d.seed);
  return picture.noise(random, d.noise);
}

// The line's first part, as an outline gives it.
Axis seen_of(const Drawing& d, float share) {
  const std::vector<Vec2> line = course(d);
  return resampled({line.data(), static_cast<std::size_t>(share * static_cast<float>(line.size()))});
}

float off_course(const Axis& axis, const Drawing& d) {
  float worst = 0;
  const std::vector<Vec2> line = course(d);
  for (const Vec2 p : axis.points) {
    float nearest = 1e9f;
    for (const Vec2 q : line) nearest = std::min(nearest, length(p - q));
    worst = std::max(worst, nearest);
  }
  return worst;
}

Axis followed(const Axis& axis, const Drawing& d, float usual_length = 0) {
  const test::Picture picture = drawn(d), ground(kWide, kHigh, kGround);
  return followed_tail(axis, picture.luma(), ground.luma(), usual_length);
}

bool same(const Axis& a, const Axis& b) {
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(),
                    [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; });
}

TEST(Tail, IsFollowedToItsEndOnEitherGround) {
  for (const float contrast : {-35.0f, 35.0f}) {
    for (const float bend : {0.0f, 0.03f, -0.03f, 0.06f}) {
      const Drawing d{.contrast = contrast, .bend = bend, .head = {20, 50}};
      const Axis axis = followed(seen_of(d, 0.85f), d);
      EXPECT_LT(length(axis.points[kStations - 1] - course(d).back()), 1.5f) << contrast << " " << bend;
      EXPECT_LT(off_course(axis, d), 1.5f) << contrast << " " << bend;
      EXPECT_NEAR(axis.length, kLength, 2);
    }
  }
}

// Single pixels differ by a quarter of the line's contrast, at its end by half of it.
TEST(Tail, IsFollowedThroughNoise) {
  std::vector<float> ends;
  for (uint64_t seed = 1; seed <= 25; ++seed) {
    const Drawing d{.noise = 9, .bend = seed % 2 == 0 ? 0.03f : -0.03f, .head = {20, 50}, .seed = seed};
    const Axis axis = followed(seen_of(d, 0.75f), d, kLength);
    ends.push_back(length(axis.points[kStations - 1] - course(d).back()));
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_LT(ends[12], 2);  // 2.5 % of the length
  EXPECT_LT(ends[22], 5);  // of nine in ten
}

TEST(Tail, AnAxisThatWentAstrayComesBackToIt) {
  const Drawing d{.noise = 5, .bend = 0.03f};
  Axis astray = seen_of(d, 0.75f);
  const Vec2 corner = astray.points[50];
  for (int j = 51; j < kStations; ++j)
    astray.points[static_cast<std::size_t>(j)] = corner + Vec2{0.2f, -1} * static_cast<float>(j - 50);
  const Axis axis = followed(astray, d, kLength);
  EXPECT_GT(off_course(astray, d), 10);
  EXPECT_LT(off_course(axis, d), 2.5f);
  EXPECT_LT(length(axis.points[kStations - 1] - course(d).back()), 3);
}

// One step at a time ends where the line is lost for a moment; the whole way is worth it.
TEST(Tail, IsFoundAgainBehindAGap) {
  const Drawing d{.noise = 4, .bend = 0.02f, .gap_from = 62, .gap_to = 67};
  const Axis axis = followed(seen_of(d, 0.75f), d, kLength);
  EXPECT_LT(length(axis.points[kStations - 1] - course(d).back()), 3);
}

// Both ends would do: the line goes on behind the gap, or something else lies there.
TEST(Tail, WhatLiesBeyondTheUsualLengthIsNotItsOwn) {
  const Drawing d{.bend = 0, .gap_from = 56, .gap_to = 65};
  const Axis whole = followed(seen_of(d, 0.68f), d, kLength), shorter = followed(seen_of(d, 0.68f), d, 56);
  EXPECT_NEAR(whole.length, kLength, 3);
  EXPECT_NEAR(shorter.length, 56, 3);
}

TEST(Tail, ABroadOneStays) {
  const Drawing d{.half_width = 4};
  const Axis axis = seen_of(d, 0.75f);
  EXPECT_TRUE(same(followed(axis, d), axis));
}

TEST(Tail, WhereThereIsNothingToSeeTheAxisStays) {
  const Drawing d;
  const Axis axis = seen_of(d, 0.75f);
  EXPECT_TRUE(same(followed_tail(axis, {}, {}, kLength), axis));
  const test::Picture empty(kWide, kHigh, kGround);
  EXPECT_TRUE(same(followed_tail(axis, empty.luma(), empty.luma(), kLength), axis));
}

TEST(Tail, ThatLeavesThePictureEndsAtItsEdge) {
  const Drawing d{.bend = 0, .head = {kWide - 65, 50}};
  const Axis axis = followed(seen_of(d, 0.75f), d);
  EXPECT_NEAR(axis.points[kStations - 1].x, kWide, 4);
  EXPECT_NEAR(axis.points[kStations - 1].y, 50, 1);
}

// The tail of a very long fish is followed from so far back as there is room for.
TEST(Tail, OfALongFishIsFollowedToo) {
  const Drawing d;
  Axis axis;
  for (int j = 0; j < kStations; ++j) axis.points[static_cast<std::size_t>(j)] = {5.0f + 6 * static_cast<float>(j), 20};
  axis.length = 6 * (kStations - 1);
  const test::Picture ground(500, 40, kGround);
  test::Picture picture(500, 40, kGround);
  for (int x = 0; x < 421; ++x) picture.at(x, 20) = kGround - 40;
  const Axis longer = followed_tail(axis, picture.luma(), ground.luma(), 415);
  EXPECT_NEAR(longer.points[kStations - 1].x, 420, 2);
}

}  // namespace
}  // namespace nt
