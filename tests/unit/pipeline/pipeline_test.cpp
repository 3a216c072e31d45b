// SPDX-License-Identifier: Apache-2.0
#include "core/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Picture;

constexpr int kWidth = 322, kHeight = 180;

class Filmed {
 public:
  explicit Filmed(const CaptureSettings& settings = {}, int width = kWidth, int height = kHeight)
      : block_(Capture::bytes_needed(limits(width, height), settings)) {
    auto made = Capture::create(block_.span(), limits(width, height), settings, width, height);
    EXPECT_TRUE(made.ok()) << made.status().message;
    capture_ = made.value();
  }
  StepReport see(const Picture& picture) {
    Frame frame;
    frame.luma = picture.luma(), frame.sequence = ++count_,
    frame.timestamp_ns = static_cast<int64_t>(count_) * 33'000'000;
    return capture_->step(frame);
  }
  void learn(const Picture& picture) { capture_->learn({.luma = picture.luma()}); }
  Capture* operator->() { return capture_; }
  static Limits limits(int width, int height) {
    Limits limits;
    limits.max_width = width, limits.max_height = height;
    return limits;
  }

 private:
  test::Block block_;
  Capture* capture_ = nullptr;
  uint64_t count_ = 0;
};

Picture empty() { return Picture(kWidth, kHeight, 170); }
// A fish that looks to the right.
Picture& draw_fish(Picture& picture, float x, float y) {
  return picture.ellipse(x + 8, y, 24, 10, 60).ellipse(x - 22, y, 24, 4, 60);
}
Picture fish_at(float x, float y) {
  Picture p = empty();
  return draw_fish(p, x, y);
}

CaptureSettings still() {
  CaptureSettings settings;
  settings.background.kind = BackgroundKind::still;
  return settings;
}

TEST(Pipeline, FollowsAFishAndSaysWhereItsHeadIs) {
  Filmed film(still());
  film.learn(empty());
  EXPECT_STREQ(film->background_name(), "still");
  EXPECT_EQ(film->init_len(), 0);
  for (int n = 0; n < 40; ++n) {
    const float x = 80 + 4.0f * static_cast<float>(n);
    const StepReport report = film.see(fish_at(x, 90));
    ASSERT_EQ(report.status, PoseStatus::ok) << n;
    EXPECT_EQ(report.blobs, 1);
    EXPECT_NEAR(film->pose().head.x, x + 32, 3);
    EXPECT_NEAR(film->pose().tail.x, x - 46, 3);
    EXPECT_NEAR(film->pose().head.y, 90, 2);
    EXPECT_GT(film->pose().dir.x, 0.99f);
  }
  EXPECT_NEAR(film->init_len(), 78, 4);
  EXPECT_FALSE(film->contour().empty());
  EXPECT_FALSE(film->smooth_contour().empty());
  EXPECT_GE(film->contour_points_high_water(), static_cast<int>(film->contour().size()));
}

TEST(Pipeline, APictureWithoutAFishIsAbsent) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still, BackgroundKind::backlit}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    Filmed film(settings);
    Random random(2);
    for (int n = 0; n < 100; ++n) {
      const StepReport report = film.see(empty().noise(random, 2));
      ASSERT_NE(report.status, PoseStatus::ok) << n;
      if (n > 0) {
        EXPECT_EQ(report.status, PoseStatus::absent);
      }
      EXPECT_FALSE(film->pose().ok());
      EXPECT_TRUE(film->contour().empty());
      EXPECT_TRUE(film->smooth_contour().empty());
    }
    EXPECT_EQ(film->init_len(), 0);
  }
}

TEST(Pipeline, WithoutAPictureToLearnFromTheFirstFrameIsOne) {
  Filmed film(still());
  EXPECT_EQ(film.see(empty()).status, PoseStatus::relearn);
  EXPECT_EQ(film.see(fish_at(100, 90)).status, PoseStatus::ok);
  film->relearn();
  EXPECT_EQ(film.see(empty()).status, PoseStatus::relearn);
}

TEST(Pipeline, AFishAtTheEdgeIsPartialAndOneThatLeftIsLostThenAbsent) {
  CaptureSettings settings = still();
  settings.lost_after = 5;
  Filmed film(settings);
  film.learn(empty());
  float x = 200;
  for (; x < 280; x += 5) EXPECT_EQ(film.see(fish_at(x, 90)).status, PoseStatus::ok) << x;
  for (x = 300; x < 340; x += 5) {
    EXPECT_EQ(film.see(fish_at(x, 90)).status, PoseStatus::partial) << x;
    EXPECT_FALSE(film->pose().ok());
    EXPECT_EQ(film->pose().confidence.head, 0);
  }
  for (int n = 0; n < 6; ++n) EXPECT_EQ(film.see(empty()).status, PoseStatus::lost) << n;
  EXPECT_EQ(film.see(empty()).status, PoseStatus::absent);
}

TEST(Pipeline, ALampCostsNotOneFrameAndIsMarked) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still, BackgroundKind::backlit}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    Filmed film(settings);
    EXPECT_EQ(film.see(empty()).flags & kRelearned, 0u);
    for (int n = 0; n < 12; ++n) (void)film.see(fish_at(100 + 3.0f * static_cast<float>(n), 90));
    Picture lit = fish_at(136, 90);
    lit.each([](int, int, int v) { return static_cast<float>(v) * 1.4f; });
    const StepReport report = film.see(lit);
    EXPECT_EQ(report.status, PoseStatus::ok) << film->background_name();
    EXPECT_NE(report.flags & kRelearned, 0u) << film->background_name();
    EXPECT_EQ(film.see(lit).flags & kRelearned, 0u);
  }
}

TEST(Pipeline, AFishOfTheFirstFrameThatOnlyBeatsItsTailIsSeenFromTheSecondOn) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    Filmed film(settings);
    Random random(4);
    for (int n = 0; n < 200; ++n) {
      Picture seen = empty();
      seen.ellipse(168, 90, 24, 10, 60).ellipse(138, 90 + static_cast<float>(n % 8), 24, 4, 60).noise(random, 2);
      const StepReport report = film.see(seen);
      EXPECT_EQ(report.status, n == 0 ? PoseStatus::relearn : PoseStatus::ok) << n;
      if (n > 0) {
        EXPECT_NEAR(film->pose().head.x, 192, 4) << n;
      }
    }
  }
}

TEST(Pipeline, AStoneOfTheFirstFrameIsGroundAfterATrial) {
  Filmed film;
  Random random(4);
  StepReport report;
  for (int n = 0; n < 200; ++n) report = film.see(fish_at(160, 90).noise(random, 2));
  EXPECT_EQ(report.status, PoseStatus::absent);
  EXPECT_EQ(report.blobs, 0);
}

// No factor explains a lamp that lights one half.
TEST(Pipeline, ALampAtOneSideThatStaysOnMakesItLearnAnew) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    Filmed film(settings);
    for (int n = 0; n < 5; ++n) EXPECT_EQ(film.see(empty()).flags & kRelearned, 0u);
    Picture lit = empty();
    lit.paint({0, 0, kWidth / 2, kHeight}, 240);
    bool relearned = false;
    int frames = 0;
    for (; frames < 30 && !relearned; ++frames) relearned = (film.see(lit).flags & kRelearned) != 0;
    EXPECT_TRUE(relearned);
    EXPECT_GT(frames, 3) << "a flash is no lamp";
    for (int n = 0; n < 3; ++n) EXPECT_EQ(film.see(lit).flags & kRelearned, 0u);
    EXPECT_EQ(film.see(draw_fish(lit, 80, 90)).status, PoseStatus::ok);
  }
}

TEST(Pipeline, AClickSelectsAndNextMovesOn) {
  Filmed film(still());
  film.learn(empty());
  Picture two = fish_at(90, 60);
  draw_fish(two, 230, 130);
  film->select_at({230, 130});
  EXPECT_EQ(film.see(two).status, PoseStatus::ok);
  EXPECT_NEAR(film->pose().centre.y, 130, 3);
  ASSERT_EQ(film->blobs().size(), 2u);
  for (const BlobView& b : film->blobs()) EXPECT_EQ(b.selected, b.centroid.y > 100);
  film->select_next();
  (void)film.see(two);
  EXPECT_NEAR(film->pose().centre.y, 60, 3);
}

TEST(Pipeline, AFrameOfAnotherSizeIsSaidAndTheNextGoesOn) {
  Filmed film(still());
  film.learn(empty());
  ASSERT_EQ(film.see(fish_at(100, 90)).status, PoseStatus::ok);
  for (const auto& [w, h] : {std::pair{kWidth - 1, kHeight}, std::pair{kWidth, kHeight + 1}, std::pair{1, 1}}) {
    const StepReport report = film.see(Picture(w, h, 170));
    EXPECT_NE(report.flags & kFrameSize, 0u);
    EXPECT_FALSE(film->pose().ok());
    EXPECT_TRUE(film->blobs().empty());
  }
  EXPECT_EQ(film.see(fish_at(104, 90)).status, PoseStatus::ok);
}

TEST(Pipeline, TheSmallestFrameWorksAndSmallerOnesAreRefused) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still, BackgroundKind::backlit}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    Filmed film(settings, 16, 16);
    Random random(5);
    for (int n = 0; n < 50; ++n) {
      Picture seen(16, 16);
      (void)film.see(seen.scatter(random));
      (void)film.see(Picture(16, 16, 100).paint({2 + n % 5, 6, 11 + n % 5, 9}, 200));
    }
    const Limits limits = Filmed::limits(16, 16);
    const test::Block block(Capture::bytes_needed(limits, settings));
    EXPECT_EQ(Capture::create(block.span(), limits, settings, 15, 16).status().code, StatusCode::bad_argument);
    EXPECT_EQ(Capture::create(block.span(), limits, settings, 16, 15).status().code, StatusCode::bad_argument);
  }
}

TEST(Pipeline, BadSettingsAreRefused) {
  for (const int size : {0, 2, -3}) {
    CaptureSettings settings;
    settings.open_size = size;
    const Limits limits = Filmed::limits(64, 64);
    const test::Block block(Capture::bytes_needed(limits, settings));
    const auto made = Capture::create(block.span(), limits, settings, 64, 64);
    EXPECT_EQ(made.status().code, StatusCode::bad_argument);
    EXPECT_NE(std::strstr(made.status().message, "open_size"), nullptr);
  }
}

TEST(Pipeline, MemoryIsExactForEveryModel) {
  for (const BackgroundKind kind : {BackgroundKind::vibe, BackgroundKind::still, BackgroundKind::backlit}) {
    CaptureSettings settings;
    settings.background.kind = kind;
    const Limits limits = Filmed::limits(101, 67);
    const std::size_t bytes = Capture::bytes_needed(limits, settings);
    const test::Block block(bytes);
    const auto made = Capture::create(block.span(), limits, settings, 101, 67);
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made.value()->bytes_used(), bytes);
    EXPECT_EQ(Capture::create(block.span().first(bytes - 1), limits, settings, 101, 67).status().code,
              StatusCode::out_of_memory);
  }
}

TEST(Pipeline, TheFingerprintFollowsTheIntegerStagesOnly) {
  CaptureSettings settings = still();
  settings.fingerprint = true;
  Filmed a(settings), b(settings);
  a.learn(empty()), b.learn(empty());
  (void)a.see(fish_at(100, 90)), (void)b.see(fish_at(100, 90));
  EXPECT_EQ(a->integer_hash(), b->integer_hash());
  (void)b.see(fish_at(101, 90));
  EXPECT_NE(a->integer_hash(), b->integer_hash());
}

// Two fish that swim side by side, the upper one a little larger.
Picture two_fish(int n) {
  const float x = 60 + 3.0f * static_cast<float>(n);
  Picture picture = empty();
  draw_fish(picture, x, 130);
  return picture.ellipse(x + 8, 50, 28, 12, 60).ellipse(x - 26, 50, 28, 5, 60);
}

TEST(Pipeline, SeveralFishHaveTheirOwnPosesAndNumbers) {
  CaptureSettings settings = still();
  settings.max_fish = 4;
  Filmed film(settings);
  film.learn(empty());
  EXPECT_EQ(film->fish_count(), 4);
  for (int n = 0; n < 50; ++n) (void)film.see(two_fish(n));
  EXPECT_EQ(film->target(), 0) << "the first that was chosen";
  ASSERT_TRUE(film->pose(0).ok());
  ASSERT_TRUE(film->pose(1).ok());
  EXPECT_FALSE(film->pose(2).ok());
  EXPECT_NEAR(film->pose(0).centre.y, 50, 3);
  EXPECT_NEAR(film->pose(1).centre.y, 130, 3);
  EXPECT_GT(film->init_len(0), film->init_len(1));
  EXPECT_FALSE(film->contour(1).empty());
  EXPECT_NE(film->contour(0).data(), film->contour(1).data());
  EXPECT_GT(film->motion(1).dir_rad, -0.2f);
  film->select_next();
  (void)film.see(two_fish(50));
  EXPECT_EQ(film->target(), 1) << "the other one is the target, the numbers stay";
  EXPECT_NEAR(film->pose().centre.y, 130, 3);
  EXPECT_NEAR(film->pose(0).centre.y, 50, 3);
}

TEST(Pipeline, OneThatComesBackIsKnownByItsLooks) {
  CaptureSettings settings = still();
  settings.max_fish = 3, settings.lost_after = 5;
  Filmed film(settings);
  film.learn(empty());
  for (int n = 0; n < 40; ++n) (void)film.see(two_fish(n));
  ASSERT_TRUE(film->pose(1).ok());
  for (int n = 0; n < 20; ++n) (void)film.see(empty());
  // Only the smaller one is back, elsewhere; then the larger one.
  for (int n = 0; n < 30; ++n) (void)film.see(fish_at(80 + 3.0f * static_cast<float>(n), 40));
  EXPECT_TRUE(film->pose(1).ok());
  EXPECT_FALSE(film->pose(0).ok());
  EXPECT_FALSE(film->pose(2).ok());
}

TEST(Pipeline, NothingOutsideTheTankIsAFishAndWhatLeavesItIsPartial) {
  Picture tank(kWidth, kHeight, 0);
  tank.paint({0, 0, kWidth, 100}, 255);
  CaptureSettings settings = still();
  settings.tank = tank.luma();
  Filmed film(settings);
  film.learn(empty());
  EXPECT_EQ(film.see(fish_at(100, 150)).status, PoseStatus::absent);
  for (int n = 0; n < 5; ++n)
    EXPECT_EQ(film.see(fish_at(100, 50 + 4.0f * static_cast<float>(n))).status, PoseStatus::ok);
  EXPECT_EQ(film.see(fish_at(100, 96)).status, PoseStatus::partial);
}

TEST(Pipeline, WhatIsTooLargeOrTooSmallIsNoFish) {
  const auto status_with = [](int least, int most) {
    CaptureSettings settings = still();
    settings.min_area_px = least, settings.max_area_px = most;
    Filmed film(settings);
    film.learn(empty());
    return film.see(fish_at(100, 90)).status;
  };
  EXPECT_EQ(status_with(0, 0), PoseStatus::ok);
  EXPECT_EQ(status_with(500, 2000), PoseStatus::ok);
  EXPECT_EQ(status_with(2000, 0), PoseStatus::absent);
  EXPECT_EQ(status_with(0, 500), PoseStatus::absent);
}

TEST(Pipeline, AFishThatGrowsTooLargeGivesNoPose) {
  CaptureSettings settings = still();
  settings.max_area_px = 700;
  Filmed film(settings);
  film.learn(empty());
  for (float x = -20; x < 100; x += 4) EXPECT_NE(film.see(fish_at(x, 90)).status, PoseStatus::ok) << x;
}

TEST(Pipeline, MoreFishTakeMoreMemoryAndBadNumbersAreRefused) {
  const Limits limits = Filmed::limits(kWidth, kHeight);
  CaptureSettings settings = still();
  const std::size_t one = Capture::bytes_needed(limits, settings);
  settings.max_fish = 8;
  const std::size_t eight = Capture::bytes_needed(limits, settings);
  EXPECT_GT(eight, one);
  EXPECT_LT(eight - one, std::size_t{8} * 100'000);
  const test::Block block(eight);
  EXPECT_TRUE(Capture::create(block.span(), limits, settings, kWidth, kHeight).ok());
  EXPECT_EQ(Capture::create(block.span().first(eight - 1), limits, settings, kWidth, kHeight).status().code,
            StatusCode::out_of_memory);
  for (const int count : {0, -1, kMostFish + 1}) {
    settings.max_fish = count;
    EXPECT_EQ(Capture::create(block.span(), limits, settings, kWidth, kHeight).status().code, StatusCode::bad_argument);
  }
  settings.max_fish = 1;
  Picture small(10, 10);
  settings.tank = small.luma();
  EXPECT_EQ(Capture::create(block.span(), limits, settings, kWidth, kHeight).status().code, StatusCode::bad_argument);
}

}  // namespace
}  // namespace nt
