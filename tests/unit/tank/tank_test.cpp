// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/base/hash.h"

namespace nt {
namespace {

uint64_t hash_of(const LumaView& view) {
  uint64_t hash = kHashSeed;
  for (int y = 0; y < view.height; ++y) hash = hash_bytes(view.row(y), static_cast<std::size_t>(view.width), hash);
  return hash;
}

LumaView render(Tank& tank, int frames) {
  LumaView view;
  for (int i = 0; i < frames; ++i) view = tank.render_next();
  return view;
}

float distance_to_line(const std::vector<Vec2>& line, Vec2 p, bool closed) {
  float best = 1e9f;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
    const Vec2 a = line[i], along = line[(i + 1) % line.size()] - a;
    const float t = std::fmax(0.0f, std::fmin(1.0f, dot(p - a, along) / std::fmax(length_sq(along), 1e-12f)));
    best = std::fmin(best, length(p - (a + along * t)));
  }
  return best;
}

bool inside(const std::vector<Vec2>& polygon, Vec2 p) {  // even-odd
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i], b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

TEST(Tank, TheSameSeedGivesTheSameBytesAnotherSeedOthers) {
  const TankSettings settings{.width = 320, .height = 180};
  Tank a(settings), b(settings), c({.seed = 2, .width = 320, .height = 180});
  for (int frame = 0; frame < 120; ++frame) {
    const uint64_t hash = hash_of(a.render_next());
    ASSERT_EQ(hash, hash_of(b.render_next())) << frame;
    ASSERT_NE(hash, hash_of(c.render_next())) << frame;
    ASSERT_EQ(a.frame_index(), frame);
  }
}

// These bytes are the same on every target. They change only when the tank's picture is changed on purpose.
TEST(Tank, GoldenFrames) {
  Tank tank({});
  EXPECT_EQ(hash_of(render(tank, 1)), 0xb50fd37a58ebd0f7ull);
  EXPECT_EQ(hash_of(render(tank, 150)), 0xf64ad37bbc74a9f4ull);
}

class TankScenesTruth : public testing::TestWithParam<std::string> {};

TEST_P(TankScenesTruth, AgreesWithItself) {
  Tank tank({.scene = GetParam(), .seed = 3});
  int checked = 0;
  for (int frame = 0; frame < 420; ++frame) {
    tank.render_next();
    if (frame % 7 != 0) continue;
    const TankTruth& truth = tank.truth(true);
    const FishPose& pose = truth.pose;
    if (!truth.visible) continue;
    ++checked;
    ASSERT_GE(truth.midline.size(), 64u);
    for (int i = 0; i < pose.u_num; ++i) ASSERT_LT(distance_to_line(truth.midline, pose.up_axis[i], false), 0.05f);
    for (int i = 0; i < pose.l_num; ++i) ASSERT_LT(distance_to_line(truth.midline, pose.low_axis[i], false), 0.05f);
    for (Vec2 p : {pose.head, pose.tail, pose.jun_tl, pose.jun_tr, pose.jun_bl, pose.jun_br})
      ASSERT_LT(distance_to_line(truth.contour, p, true), 0.3f) << frame;
    ASSERT_TRUE(inside(truth.contour, pose.centre)) << frame;
    ASSERT_NEAR(length(pose.dir), 1.0f, 1e-4f);
    const auto& line = truth.midline;
    float length_px = 0;
    for (std::size_t i = 1; i < line.size(); ++i) length_px += length(line[i] - line[i - 1]);
    ASSERT_NEAR(length_px, pose.axis_len, 0.01f * pose.axis_len);
    // Left of the body's own direction is a negative cross product with y down.
    const Vec2 ahead = line[line.size() / 4 - 4] - line[line.size() / 4 + 4];
    const Vec2 root = line[line.size() / 4];
    ASSERT_LT(cross(ahead, pose.l_fin - root), 0.0f) << frame;
    ASSERT_GT(cross(ahead, pose.r_fin - root), 0.0f) << frame;
  }
  EXPECT_GT(checked, 15);
}

TEST_P(TankScenesTruth, TheMaskIsTheFilledContour) {
  Tank tank({.scene = GetParam(), .seed = 5});
  render(tank, 150);
  const TankTruth& truth = tank.truth(true);
  ASSERT_EQ(truth.mask.size(), 960u * 544u);
  int both = 0, either = 0;
  for (int y = 0; y < 544; ++y)
    for (int x = 0; x < 960; ++x) {
      const bool a = truth.mask[static_cast<std::size_t>(y) * 960 + x] != 0;
      const bool b = inside(truth.contour, {static_cast<float>(x), static_cast<float>(y)});
      both += a && b;
      either += a || b;
    }
  ASSERT_GT(either, 100);
  EXPECT_GT(both, 0.98 * either);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TankScenesTruth, testing::ValuesIn(tank_scene_names()),
                         [](const auto& scene_name) { return scene_name.param; });

TEST(Tank, TheFishIsBrighterThanTheGravelWhereTheMaskSaysSo) {
  Tank tank({});
  const LumaView view = render(tank, 150);
  const TankTruth& truth = tank.truth(true);
  double sum[2] = {0, 0}, squares = 0, count[2] = {0, 0};
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const int fish = truth.mask[static_cast<std::size_t>(y) * view.width + x] != 0;
      const double v = view.row(y)[x];
      sum[fish] += v;
      count[fish] += 1;
      if (fish == 0) squares += v * v;
    }
  const double gravel = sum[0] / count[0];
  EXPECT_GT(sum[1] / count[1], gravel + 45);
  EXPECT_NEAR(gravel, 92, 5);
  EXPECT_NEAR(std::sqrt(squares / count[0] - gravel * gravel), 12.5, 2);
}

TEST(Tank, LumaOfTheColourIsTheLuma) {
  Tank tank({.width = 480, .height = 272});
  const LumaView view = render(tank, 100);
  const auto rgb = tank.rgb();
  ASSERT_EQ(rgb.size(), 480u * 272u * 3u);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const uint8_t* p = &rgb[(static_cast<std::size_t>(y) * 480 + x) * 3];
      ASSERT_NEAR(0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2], view.row(y)[x], 2.0) << x << "," << y;
    }
}

TEST(Tank, TheFishIsOrange) {
  Tank tank({.width = 480, .height = 272});
  render(tank, 100);
  const auto rgb = tank.rgb();
  const TankTruth& truth = tank.truth(true);
  double sum[3] = {0, 0, 0}, count = 0;
  for (std::size_t i = 0; i < truth.mask.size(); ++i) {
    if (truth.mask[i] == 0) continue;
    for (int c = 0; c < 3; ++c) sum[c] += rgb[3 * i + c];
    count += 1;
  }
  EXPECT_GT(sum[0], sum[1] + 40 * count);
  EXPECT_GT(sum[1], sum[2] + 60 * count);
}

TEST(Tank, CalmStaysInTheFrameMovesSmoothlyAndUsesItsFins) {
  for (uint64_t seed : {1, 2, 3}) {
    Tank tank({.seed = seed, .width = 480, .height = 272});
    int open = 0, folded = 0, seen_since = -1;
    Vec2 head, tail;
    for (int frame = 0; frame < 2000; ++frame) {
      tank.render_next();
      const TankTruth& truth = tank.truth();
      if (frame > 0) {
        ASSERT_LT(length(truth.pose.head - head), 0.1f * truth.pose.axis_len) << frame;
        ASSERT_LT(length(truth.pose.tail - tail), 0.1f * truth.pose.axis_len) << frame;
      }
      head = truth.pose.head;
      tail = truth.pose.tail;
      if (truth.visible && seen_since < 0) seen_since = frame;
      if (seen_since < 0) continue;
      ASSERT_TRUE(truth.visible) << "seed " << seed << " frame " << frame;
      for (float confidence : {truth.pose.confidence.l_fin, truth.pose.confidence.r_fin}) {
        open += confidence == 1.0f;
        folded += confidence == 0.0f;
      }
    }
    EXPECT_LT(seen_since, 90);
    EXPECT_GT(open, 400);
    EXPECT_GT(folded, 400);
  }
}

TEST(Tank, LeaveLeavesAndComesBack) {
  Tank tank({.scene = "leave", .width = 320, .height = 180});
  int left = 0, returned = 0;
  PoseStatus last = PoseStatus::absent;
  bool gone = false, seen = false;
  for (int frame = 0; frame < 2000; ++frame) {
    tank.render_next();
    const PoseStatus status = tank.truth().pose.status;
    if (status == PoseStatus::absent && last == PoseStatus::partial && seen) ++left, gone = true;
    if (status == PoseStatus::ok && gone) ++returned, gone = false;
    seen = seen || status == PoseStatus::ok;
    last = status;
  }
  EXPECT_GE(left, 2);
  EXPECT_GE(returned, 2);
}

TEST(Tank, TurnsBendPastNinetyDegrees) {
  Tank tank({.scene = "turns", .width = 320, .height = 180});
  int strong = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    tank.render_next();
    const auto& line = tank.truth().midline;
    const Vec2 front = line[0] - line[1], back = line[line.size() - 2] - line[line.size() - 1];
    strong += std::fabs(std::atan2(cross(front, back), dot(front, back))) > 1.5708f;
  }
  EXPECT_GT(strong, 30);
}

TEST(Tank, HoverStops) {
  Tank tank({.scene = "hover", .width = 320, .height = 180});
  render(tank, 450);
  const Vec2 centre = tank.truth().pose.centre;
  render(tank, 300);
  EXPECT_LT(length(tank.truth().pose.centre - centre), 0.1f * tank.truth().pose.axis_len);
  EXPECT_TRUE(tank.truth().visible);
}

TEST(Tank, TheFishScalesWithTheFrame) {
  const int sizes[][2] = {{160, 90}, {162, 91}, {640, 360}, {1920, 1080}};
  for (const auto& size : sizes) {
    Tank tank({.width = size[0], .height = size[1]});
    const LumaView view = render(tank, 200);
    EXPECT_EQ(view.width, size[0]);
    EXPECT_EQ(view.height, size[1]);
    EXPECT_TRUE(tank.truth().visible);
    EXPECT_NEAR(tank.truth().pose.axis_len, 220.0f * static_cast<float>(size[0]) / 960.0f, 1.0f);
  }
}

TEST(Tank, TheFrameRateOnlySamplesTheMotion) {
  Tank slow({.width = 320, .height = 180, .fps = 30}), fast({.width = 320, .height = 180, .fps = 60});
  render(slow, 151);  // 5 s after frame 0
  render(fast, 301);
  EXPECT_LT(length(slow.truth().pose.head - fast.truth().pose.head), 1.0f);
}

}  // namespace
}  // namespace nt
