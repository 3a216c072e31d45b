// SPDX-License-Identifier: Apache-2.0
// What the scenes that make capture hard promise, seen from the outside: frames and their truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/hash.h"
#include "platform/sim/tank.h"

namespace nt {
namespace {

constexpr int kWidth = 480, kHeight = 272;

Tank make(const char* scene, uint64_t seed = 1) {
  return Tank({.scene = scene, .seed = seed, .width = kWidth, .height = kHeight});
}

uint64_t hash_of(const LumaView& view) {
  uint64_t hash = kHashSeed;
  for (int y = 0; y < view.height; ++y) hash = hash_bytes(view.row(y), static_cast<std::size_t>(view.width), hash);
  return hash;
}

double mean_of(const LumaView& view) {
  double sum = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) sum += view.row(y)[x];
  return sum / view.width / view.height;
}

bool overlaps(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) return true;
  return false;
}

TEST(TankHardScenes, TheSameSeedGivesTheSameBytes) {
  for (const char* scene : {"ghost", "station", "lamp", "surface", "dirt", "shake", "ring", "crossing", "long"}) {
    Tank a = make(scene, 6), b = make(scene, 6), c = make(scene, 7);
    for (int frame = 0; frame < 60; ++frame) {
      const uint64_t hash = hash_of(a.render_next());
      ASSERT_EQ(hash, hash_of(b.render_next())) << scene << frame;
      ASSERT_NE(hash, hash_of(c.render_next())) << scene << frame;
    }
  }
}

// The same on every target, 240 frames of each: they change only when the picture is changed on purpose.
TEST(TankHardScenes, GoldenFrames) {
  const std::pair<const char*, uint64_t> kFrames[] = {
      {"ghost", 0x97dc8dd46ddd45aaull},   {"station", 0x94d965536db5df7full},  {"lamp", 0x3e60572ed47965ffull},
      {"surface", 0x4566e028c26b1896ull}, {"dirt", 0x5486e64b310ebc8eull},     {"shake", 0x318627606e9d05ffull},
      {"ring", 0x57aa300aacc610d9ull},    {"crossing", 0xf8c7a6cc781e79dbull}, {"long", 0x8ac26c3f5e70ab9dull},
  };
  for (const auto& [scene, expected] : kFrames) {
    Tank tank = make(scene);
    uint64_t hash = kHashSeed;
    for (int frame = 0; frame < 240; ++frame) {
      const LumaView view = tank.render_next();
      for (int y = 0; y < view.height; ++y) hash = hash_bytes(view.row(y), static_cast<std::size_t>(view.width), hash);
    }
    EXPECT_EQ(hash, expected) << scene;
  }
}

TEST(TankHardScenes, GhostIsThereAtOnceAndSwimsOff) {
  for (uint64_t seed : {1, 2, 3}) {
    Tank tank = make("ghost", seed);
    tank.render_next();
    ASSERT_TRUE(tank.truth().visible);
    const std::vector<uint8_t> first = tank.truth(true).mask;
    bool uncovered = false;
    for (int frame = 1; frame < 150; ++frame) {
      tank.render_next();
      uncovered = uncovered || !overlaps(first, tank.truth(true).mask);
    }
    EXPECT_TRUE(uncovered) << seed;
  }
}

TEST(TankHardScenes, StationKeepsItsPlaceWhileItsTailBeats) {
  for (uint64_t seed : {1, 2, 3}) {
    Tank tank = make("station", seed);
    tank.render_next();
    ASSERT_TRUE(tank.truth().visible);
    const FishPose first = tank.truth().pose;
    float tail_lo = 1e9f, tail_hi = -1e9f;
    for (int frame = 1; frame < 900; ++frame) {
      tank.render_next();
      const FishPose& pose = tank.truth().pose;
      ASSERT_TRUE(pose.ok());
      ASSERT_LT(length(pose.centre - first.centre), 0.04f * pose.axis_len) << frame;
      tail_lo = std::min(tail_lo, pose.tail.y);
      tail_hi = std::max(tail_hi, pose.tail.y);
    }
    EXPECT_GT(tail_hi - tail_lo, 0.06f * first.axis_len);
  }
}

TEST(TankHardScenes, LampStepsAtOneFrame) {
  Tank tank = make("lamp");
  double last = 0, largest = 0;
  int at = -1;
  for (int frame = 0; frame < 300; ++frame) {
    const double mean = mean_of(tank.render_next());
    if (frame > 0 && std::fabs(mean - last) > largest) largest = std::fabs(mean - last), at = frame;
    last = mean;
  }
  EXPECT_EQ(at, 180);
  EXPECT_NEAR(largest, 0.38 * 93, 6);
}

// Best shift, within 12 px, of a patch of gravel between two pictures.
Vec2 patch_shift(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int x0, int y0) {
  constexpr int kPatch = 32, kReach = 12;
  const auto at = [](const std::vector<uint8_t>& v, int x, int y) {
    return v[static_cast<std::size_t>(y) * kWidth + x];
  };
  int64_t best = INT64_MAX;
  Vec2 shift;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      int64_t sum = 0;
      for (int y = y0; y < y0 + kPatch; ++y)
        for (int x = x0; x < x0 + kPatch; ++x) sum += std::abs(at(a, x, y) - at(b, x + dx, y + dy));
      if (sum < best) best = sum, shift = {static_cast<float>(dx), static_cast<float>(dy)};
    }
  return shift;
}

std::vector<uint8_t> copy_of(const LumaView& view) {
  std::vector<uint8_t> out;
  for (int y = 0; y < view.height; ++y) out.insert(out.end(), view.row(y), view.row(y) + view.width);
  return out;
}

TEST(TankHardScenes, ShakeMovesTheGravelAndTheTruthStaysOnTheFish) {
  Tank tank = make("shake"), calm = make("calm");
  std::vector<uint8_t> first;
  float moved = 0, scale_lo = 1e9f, scale_hi = 0;
  for (int frame = 0; frame < 240; ++frame) {
    const LumaView view = tank.render_next();
    const bool looks = frame % 40 == 0;
    if (frame == 0) first = copy_of(view);
    if (looks) moved = std::max(moved, length(patch_shift(first, copy_of(view), 30, 20)));
    const TankTruth& truth = tank.truth(looks);
    scale_lo = std::min(scale_lo, truth.pose.axis_len);
    scale_hi = std::max(scale_hi, truth.pose.axis_len);
    if (!looks || !truth.visible) continue;
    // Bright where the mask says so: within it nearly all, in a ring of four pixels round its box nearly none.
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (std::size_t i = 0; i < truth.mask.size(); ++i) {
      const int fish = truth.mask[i] != 0;
      const uint8_t v = view.row(static_cast<int>(i / kWidth))[i % kWidth];
      sum[fish] += v > 130;
      count[fish] += 1;
    }
    EXPECT_GT(sum[1], 0.85 * count[1]) << frame;
    EXPECT_LT(sum[0], 0.02 * count[0]) << frame;
  }
  EXPECT_GT(moved, 2.0f);
  EXPECT_GT(scale_hi, 1.01f * scale_lo);
  // The tank behind the camera is the same: only its view differs.
  calm.render_next();
  EXPECT_NEAR(calm.truth().pose.axis_len, 0.5f * (scale_lo + scale_hi), 0.04f * scale_hi);
}

TEST(TankHardScenes, RingClosesUntilHeadMeetsTailAndOpensAgain) {
  for (uint64_t seed : {1, 2, 3}) {
    Tank tank = make("ring", seed);
    int closings = 0;
    bool closed = false;
    for (int frame = 0; frame < 600; ++frame) {
      tank.render_next();
      const FishPose& pose = tank.truth().pose;
      const float apart = length(pose.head - pose.tail) / pose.axis_len;
      if (!closed && apart < 0.12f) closed = true, ++closings;
      if (closed && apart > 0.85f) closed = false;
    }
    EXPECT_GE(closings, 2) << seed;
    EXPECT_FALSE(closed && closings < 2) << seed;
  }
}

// Surface and dirt change the picture, not the fish: its truth is that of the same scene without them.
TEST(TankHardScenes, SurfaceAndDirtLeaveTheTruthAlone) {
  Tank surface = make("surface"), dirt = make("dirt");
  int visible = 0, absent = 0;
  for (int frame = 0; frame < 900; ++frame) {
    ASSERT_NE(hash_of(surface.render_next()), hash_of(dirt.render_next()));
    const FishPose &a = surface.truth().pose, &b = dirt.truth().pose;
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(length(a.head - b.head) + length(a.tail - b.tail) + length(a.l_fin - b.l_fin), 0.0f) << frame;
    visible += a.ok();
    absent += a.status == PoseStatus::absent;
  }
  EXPECT_GT(visible, 400);
  EXPECT_GT(absent, 100);  // frames in which any pose is a false one
}

// As long as 100,000 frames at 30 a second, by a camera that films only two of them.
TEST(TankHardScenes, LongNeitherDriftsNorGrows) {
  Tank tank({.scene = "long", .width = 96, .height = 64, .fps = 2});
  double first = 0, last = 0;
  int visible = 0;
  Vec2 lo{1e9f, 1e9f}, hi;
  for (int frame = 0; frame < 6700; ++frame) {
    const LumaView view = tank.render_next();
    const TankTruth& truth = tank.truth();
    if (frame < 20) continue;
    visible += truth.visible;
    ASSERT_NEAR(truth.pose.axis_len, 0.229f * 96, 0.01f) << frame;
    if (frame < 1020) first += mean_of(view) / 1000;
    if (frame < 5700) continue;
    last += mean_of(view) / 1000;
    lo = {std::min(lo.x, truth.pose.centre.x), std::min(lo.y, truth.pose.centre.y)};
    hi = {std::max(hi.x, truth.pose.centre.x), std::max(hi.y, truth.pose.centre.y)};
  }
  EXPECT_GT(visible, 6600);
  EXPECT_NEAR(first, last, 0.5);
  EXPECT_GT(hi.x - lo.x, 20.0f);  // it still swims about
  EXPECT_GT(hi.y - lo.y, 10.0f);
}

}  // namespace
}  // namespace nt
