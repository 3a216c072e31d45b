// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/sim_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

TankSettings small_tank() {
  TankSettings settings;
  settings.width = 320;
  settings.height = 240;
  settings.fps = 30;
  settings.seed = 7;
  return settings;
}

std::vector<uint8_t> pixels_of(const Frame& frame) {
  std::vector<uint8_t> out;
  for (int y = 0; y < frame.luma.height; ++y)
    out.insert(out.end(), frame.luma.row(y), frame.luma.row(y) + frame.luma.width);
  return out;
}

TEST(SimCamera, GivesTheAskedFramesWithExactTimes) {
  const auto camera = open_sim_camera(small_tank(), 4);
  EXPECT_EQ(camera->info().name, "sim:scene=calm");
  EXPECT_EQ(camera->info().width, 320);
  EXPECT_EQ(camera->info().source_height, 240);
  EXPECT_EQ(camera->info().frame_count, 4);
  EXPECT_EQ(camera->truth(), nullptr);
  EXPECT_EQ(camera->picture().pixels, nullptr);
  for (int n = 0; n < 4; ++n) {
    const auto frame = camera->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sequence, static_cast<uint64_t>(n));
    EXPECT_EQ(frame->timestamp_ns, std::llround(n * 1e9 / 30));
    EXPECT_EQ(frame->luma.width, 320);
    EXPECT_EQ(frame->luma.height, 240);
  }
  EXPECT_FALSE(camera->next());
  EXPECT_FALSE(camera->next());
}

TEST(SimCamera, PictureIsTheFrameInColour) {
  const auto camera = open_sim_camera(small_tank(), 2);
  const auto frame = camera->next();
  const Picture picture = camera->picture();
  ASSERT_EQ(picture.format, PixelFormat::rgb8);
  ASSERT_EQ(picture.width, 320);
  ASSERT_EQ(picture.height, 240);
  double rgb = 0, luma = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const uint8_t* p = picture.pixels + y * picture.stride + 3 * x;
      rgb += 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
      luma += frame->luma.row(y)[x];
    }
  }
  EXPECT_NEAR(rgb / (320 * 240), luma / (320 * 240), 25);
  const uint64_t revision = picture.revision;
  ASSERT_TRUE(camera->next());
  EXPECT_NE(camera->picture().revision, revision);
}

TEST(SimCamera, TruthFollowsTheFrames) {
  const auto camera = open_sim_camera(small_tank(), -1);
  EXPECT_EQ(camera->info().frame_count, -1);
  Vec2 first, last;
  for (int n = 0; n < 60; ++n) {
    ASSERT_TRUE(camera->next());
    const TankTruth* truth = camera->truth_with_mask(n == 59);
    ASSERT_NE(truth, nullptr);
    (n == 0 ? first : last) = truth->pose.centre;
  }
  EXPECT_GT(length(last - first), 0);
  const TankTruth* truth = camera->truth_with_mask();
  ASSERT_EQ(truth->mask.size(), 320u * 240u);
  EXPECT_GT(std::count(truth->mask.begin(), truth->mask.end(), 255), 100);
}

TEST(SimCamera, RewindsToTheSameFrames) {
  const auto camera = open_sim_camera(small_tank(), 3);
  const std::vector<uint8_t> first = pixels_of(*camera->next());
  const std::vector<uint8_t> second = pixels_of(*camera->next());
  EXPECT_NE(first, second);
  ASSERT_TRUE(camera->rewind());
  EXPECT_EQ(pixels_of(*camera->next()), first);
  EXPECT_EQ(pixels_of(*camera->next()), second);
}

TEST(SimCamera, TheWorkingSizeShrinksTheFrameAndNotTheTruth) {
  const auto whole = open_sim_camera(small_tank(), 1);
  const auto half = open_sim_camera(small_tank(), 1, 160, 400);
  const LumaView a = whole->next()->luma, b = half->next()->luma;
  ASSERT_EQ(b.width, 160);
  ASSERT_EQ(b.height, 120);
  EXPECT_EQ(half->info().source_width, 320);
  for (int y = 0; y < b.height; ++y) {
    for (int x = 0; x < b.width; ++x) {
      const int sum =
          a.row(2 * y)[2 * x] + a.row(2 * y)[2 * x + 1] + a.row(2 * y + 1)[2 * x] + a.row(2 * y + 1)[2 * x + 1];
      ASSERT_NEAR(b.row(y)[x], sum / 4.0, 0.5) << x << "," << y;
    }
  }
  const Picture picture = half->picture();
  EXPECT_EQ(picture.width, 160);
  EXPECT_EQ(picture.height, 120);
  EXPECT_EQ(picture.stride, 160 * 3);
  EXPECT_NE(picture.pixels, nullptr);
  EXPECT_EQ(half->truth()->pose.centre.x, whole->truth()->pose.centre.x);
}

TEST(SimCamera, WhatCannotBeIsOneLine) {
  const auto opening = [](void (*change)(TankSettings&)) {
    TankSettings settings = small_tank();
    change(settings);
    return user_error([&] { open_sim_camera(settings, 1); });
  };
  EXPECT_NE(opening([](TankSettings& s) { s.scene = "desert"; }).find("no scene is called \"desert\"; known: "),
            std::string::npos);
  EXPECT_NE(opening([](TankSettings& s) { s.scene = "desert"; }).find("calm"), std::string::npos);
  EXPECT_NE(opening([](TankSettings& s) { s.width = 1; }).find("size=1x240 cannot be"), std::string::npos);
  EXPECT_NE(opening([](TankSettings& s) { s.height = 4321; }).find("use 64x48 to 7680x4320"), std::string::npos);
  EXPECT_NE(opening([](TankSettings& s) { s.fps = 0; }).find("fps must be above 0"), std::string::npos);
}

}  // namespace
}  // namespace nt
