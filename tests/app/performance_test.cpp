// SPDX-License-Identifier: Apache-2.0
#include "app/take/performance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/property.h"
#include "platform/camera.h"

namespace nt {
namespace {

// A fish that swims a pixel a frame to the right and beats its tail once in 20 frames.
EditedTake swimming(std::size_t count) {
  EditedTake take;
  take.info.fps = 20, take.info.width = take.info.source_width = 640;
  take.init_len = 100;
  for (std::size_t i = 0; i < count; ++i) {
    Motion m = straight_motion(3, 15);
    m.status = PoseStatus::ok, m.confidence = {1, 1, 1, 0, 0, 1};
    m.centre = {static_cast<float>(i), 50};
    m.tail_angle += 0.4f * std::sin(6.2831853f * static_cast<float>(i) / 20);
    take.clip.motions.push_back(m);
  }
  return take;
}

void lose(EditedTake& take, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i <= last; ++i) {
    take.clip.motions[i].status = PoseStatus::lost;
    take.clip.motions[i].centre = first > 0 ? take.clip.motions[first - 1].centre : Vec2{};
  }
}

TEST(Performance, IsTheTakeItselfUnlessAskedOtherwise) {
  const Performance shown = performance(swimming(50), {});
  ASSERT_EQ(shown.frames.size(), 50u);
  EXPECT_EQ(shown.fps, 20);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_TRUE(shown.frames[i].seen);
    EXPECT_EQ(shown.frames[i].motion.centre.x, static_cast<float>(i));
    EXPECT_EQ(shown.frames[i].init_len, 100);
  }
}

TEST(Performance, ARateSetsFramesBetween) {
  Moments moments;
  moments.rate = 60.0;
  moments.range = Moments::Range{10, 20};
  const Performance shown = performance(swimming(50), moments);
  ASSERT_EQ(shown.frames.size(), 31u);
  for (std::size_t i = 0; i < 31; ++i)
    EXPECT_NEAR(shown.frames[i].motion.centre.x, 10 + static_cast<float>(i) / 3, 1e-3f);
  moments.speed = 2;
  EXPECT_EQ(performance(swimming(50), moments).frames.size(), 16u);
}

TEST(Performance, ShortGapsAreBridgedAndLongOnesHeld) {
  EditedTake take = swimming(60);
  lose(take, 0, 4), lose(take, 10, 13), lose(take, 30, 40);
  const Performance shown = performance(take, {});
  for (std::size_t i = 0; i < 60; ++i) {
    const bool held = i < 5 || (i >= 30 && i <= 40);
    EXPECT_EQ(shown.frames[i].seen, !held) << i;
    const float x = i < 5 ? 5 : (held ? 29 : static_cast<float>(i));
    EXPECT_NEAR(shown.frames[i].motion.centre.x, x, 1e-4f) << i;
    const bool lost = held || (i >= 10 && i <= 13);
    EXPECT_EQ(shown.frames[i].motion.status, lost ? PoseStatus::lost : PoseStatus::ok) << i;
  }
}

TEST(Performance, ALoopClosesAtAnyRate) {
  for (const double rate : {20.0, 50.0, 13.0}) {
    Moments moments;
    moments.loop = true, moments.range = Moments::Range{3, 44}, moments.rate = rate;  // two beats and two frames
    const Performance shown = performance(swimming(80), moments);
    EXPECT_EQ(shown.frames.size(), static_cast<std::size_t>(std::round(42 * rate / 20)));
    EXPECT_NEAR(shown.seam.angle_rad, 0.4 * (1 - std::sin(0.3 * 3.14159265)), 1e-4);  // frame 45 against frame 3
    EXPECT_NEAR(shown.seam.drift_px, 42, 1e-3);
    float step = 0;
    for (std::size_t i = 0; i + 1 < shown.frames.size(); ++i)
      step = std::max(step, std::abs(shown.frames[i + 1].motion.tail_angle - shown.frames[i].motion.tail_angle));
    EXPECT_LT(std::abs(shown.frames.back().motion.tail_angle - shown.frames.front().motion.tail_angle), 1.1f * step);
    EXPECT_NEAR(shown.frames.back().motion.centre.x, shown.frames.front().motion.centre.x, 2);
  }
}

TEST(Performance, NothingToShowIsSaid) {
  EditedTake take = swimming(10);
  lose(take, 0, 9);
  EXPECT_FALSE(has_pose(performance(take, {})));
  EXPECT_TRUE(has_pose(performance(swimming(10), {})));
  Moments moments;
  moments.range = Moments::Range{5, 10};
  EXPECT_THROW(performance(swimming(10), moments), UserError);
  EXPECT_THROW(parse_range("--range", "7:3"), UserError);
  EXPECT_THROW(parse_range("--range", "7"), UserError);
  EXPECT_EQ(parse_range("--range", "3:7").last, 7);
}

}  // namespace
}  // namespace nt
