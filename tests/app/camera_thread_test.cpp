// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/camera_thread.h"

#include <gtest/gtest.h>

#include <atomic>

#include "platform/linux/clock.h"
#include "platform/sim/sim_camera.h"

namespace nt {
namespace {

constexpr int64_t kMillisecond_ns = 1'000'000;

// Grey frames of which each pixel is the frame's number.
class Counting : public Camera {
 public:
  explicit Counting(int64_t frames, double fps = 1000) : frames_(frames) {
    info_.name = "counting", info_.fps = fps;
    info_.width = info_.source_width = 40, info_.height = info_.source_height = 30;
  }
  const CameraInfo& info() const override { return info_; }
  std::optional<Frame> next() override {
    if (fail_at_ >= 0 && at_ == fail_at_) throw UserError("counting: it broke");
    if (at_ >= frames_) return std::nullopt;
    pixels_.assign(40 * 30, static_cast<uint8_t>(at_));
    Frame frame;
    frame.luma = {pixels_.data(), 40, 30, 40};
    frame.sequence = static_cast<uint64_t>(at_++);
    frame.timestamp_ns = static_cast<int64_t>(static_cast<double>(frame.sequence) * 1e9 / info_.fps);
    return frame;
  }
  Picture picture() const override { return {pixels_.data(), 40, 30, 40, PixelFormat::luma8, 0, 0}; }
  std::string warning() const override { return "counting: all is well"; }
  int64_t fail_at_ = -1;
  std::atomic<int64_t> at_{0};  // the frame that is asked for next

 private:
  CameraInfo info_;
  int64_t frames_;
  std::vector<uint8_t> pixels_;
};

TEST(CameraThread, AtEveryPaceNoFrameIsLostHoweverSlowItsUser) {
  CameraThread camera(std::make_unique<Counting>(40), {Pace::every, true, false, {}});
  for (int i = 0; i < 40; ++i) {
    const std::optional<Frame> frame = camera.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sequence, static_cast<uint64_t>(i));
    EXPECT_EQ(frame->luma.row(29)[39], i);
    EXPECT_EQ(camera.picture().pixels[0], i);
    EXPECT_EQ(camera.epoch_ns(), 0);
    if (i % 8 == 0) sleep_until_ns(steady_now_ns() + 2 * kMillisecond_ns);
    EXPECT_EQ(frame->luma.row(0)[0], i) << "the slot was written while it was looked at";
  }
  EXPECT_FALSE(camera.next());
  EXPECT_FALSE(camera.next());
  camera.stop();
  EXPECT_EQ(camera.warning(), "counting: all is well");
}

TEST(CameraThread, AtTheClocksPaceASlowUserMissesFramesAndTheCameraGoesOn) {
  CameraThread camera(std::make_unique<Counting>(200, 500), {Pace::clock, false, false, {}});
  uint64_t last = 0;
  int64_t gaps = 0, got = 0;
  const int64_t start_ns = steady_now_ns();
  while (const std::optional<Frame> frame = camera.next()) {
    if (got++ > 0) gaps += static_cast<int64_t>(frame->sequence - last) - 1;
    EXPECT_GT(camera.epoch_ns(), start_ns - 50 * kMillisecond_ns);
    last = frame->sequence;
    sleep_until_ns(steady_now_ns() + 10 * kMillisecond_ns);  // five frame times
  }
  EXPECT_GT(gaps, 50) << "the camera was made to wait";
}

TEST(CameraThread, AClipKeepsItsFrameRate) {
  CameraThread camera(std::make_unique<Counting>(20, 100), {Pace::clock, false, false, {}});
  const int64_t start_ns = steady_now_ns();
  while (camera.next()) {
  }
  EXPECT_GE(steady_now_ns() - start_ns, 180 * kMillisecond_ns);
}

TEST(CameraThread, WhatTheCameraThrowsComesOutAfterTheFramesBefore) {
  auto counting = std::make_unique<Counting>(40);
  counting->fail_at_ = 7;
  CameraThread camera(std::move(counting), {Pace::every, false, false, {}});
  int got = 0;
  try {
    while (camera.next()) ++got;
    ADD_FAILURE() << "no error";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "counting: it broke");
  }
  EXPECT_EQ(got, 7);
}

TEST(CameraThread, APausedClipStandsStill) {
  auto counting = std::make_unique<Counting>(1'000'000, 500);
  const std::atomic<int64_t>& asked_for = counting->at_;
  CameraThread camera(std::move(counting), {Pace::clock, false, false, {}});
  ASSERT_TRUE(camera.next());
  camera.pause(true);
  int64_t last = -1;  // what was under way comes in
  while (last != asked_for) last = asked_for, sleep_until_ns(steady_now_ns() + 200 * kMillisecond_ns);
  sleep_until_ns(steady_now_ns() + 200 * kMillisecond_ns);
  EXPECT_EQ(asked_for, last);
  camera.pause(false);
  for (int i = 0; i < 1000 && asked_for == last; ++i) sleep_until_ns(steady_now_ns() + 20 * kMillisecond_ns);
  EXPECT_GT(asked_for, last);
}

TEST(CameraThread, TheTanksTruthTravelsWithItsFrame) {
  const TankSettings tank{.scene = "calm", .seed = 1, .width = 320, .height = 180, .fps = 30};
  const std::unique_ptr<SimCamera> alone = open_sim_camera(tank, 12);
  CameraThread camera(open_sim_camera(tank, 12), {Pace::every, true, true, {}});
  while (const std::optional<Frame> frame = camera.next()) {
    ASSERT_TRUE(alone->next());
    ASSERT_NE(camera.truth(), nullptr);
    EXPECT_EQ(camera.truth()->pose.centre.x, alone->truth()->pose.centre.x) << frame->sequence;
    EXPECT_EQ(camera.picture().pixels[0], alone->picture().pixels[0]);
  }
}

TEST(CameraThread, ItEndsAtOnceWhenNobodyTakesItsFrames) {
  const int64_t start_ns = steady_now_ns();
  { const CameraThread camera(std::make_unique<Counting>(1'000'000), {Pace::every, false, false, {}}); }
  EXPECT_LT(steady_now_ns() - start_ns, 5'000 * kMillisecond_ns);
}

}  // namespace
}  // namespace nt
