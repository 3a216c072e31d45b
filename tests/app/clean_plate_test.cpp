// SPDX-License-Identifier: Apache-2.0
#include "app/clean_plate.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "app/camera_spec.h"
#include "platform/linux/heap_count.h"

namespace nt {
namespace {

constexpr int kWidth = 150, kHeight = 40;  // not a whole number of words

// A tank whose grey rises to the right, with a white square fish.
class Tank {
 public:
  explicit Tank(int channels) : channels_(channels), pixels_(static_cast<std::size_t>(kWidth * kHeight * channels)) {}
  static int ground(int x) { return 40 + x; }
  void film(int fish_x) {
    mask_.assign(static_cast<std::size_t>(words_for(kWidth) * kHeight), 0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool fish = fish_x >= 0 && std::abs(x - fish_x) <= 10 && std::abs(y - 20) <= 8;
        if (fish) mask().set(x, y);
        for (int c = 0; c < channels_; ++c) {
          pixels_[static_cast<std::size_t>((y * kWidth + x) * channels_ + c)] =
              static_cast<uint8_t>(fish ? 255 : ground(x) + 10 * c);
        }
      }
    }
  }
  Picture picture() const {
    return {pixels_.data(),
            kWidth,
            kHeight,
            kWidth * channels_,
            channels_ == 1 ? PixelFormat::luma8 : PixelFormat::rgb8,
            0,
            0};
  }
  BitMask mask() { return {mask_.data(), kWidth, kHeight, words_for(kWidth)}; }

 private:
  int channels_;
  std::vector<uint8_t> pixels_;
  std::vector<uint64_t> mask_;
};

// Largest difference between the plate and the empty tank.
int worst(const Picture& shown, int channels) {
  int most = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < channels; ++c) {
        const int value = shown.pixels[y * shown.stride + x * channels + c];
        most = std::max(most, std::abs(value - Tank::ground(x) - 10 * c));
      }
    }
  }
  return most;
}

TEST(CleanPlate, WhereTheFishIsItShowsWhatWasThereBefore) {
  for (const int channels : {1, 3}) {
    Tank tank(channels);
    CleanPlate plate(kWidth, kHeight);
    for (int x = 20; x < 130; x += 7) {
      tank.film(x == 20 ? -1 : x);
      plate.update(tank.picture(), {}, x == 20 ? BitMask{} : tank.mask());
      EXPECT_LE(worst(plate.picture(), channels), 1) << x;
    }
  }
}

TEST(CleanPlate, WhatWasNeverFreeIsBlendedFromItsSides) {
  Tank tank(3);
  for (const int x : {75, 12, 140}) {  // in the middle, at the left and at the right edge, each from the first frame on
    CleanPlate fresh(kWidth, kHeight);
    tank.film(x);
    fresh.update(tank.picture(), tank.mask(), {});
    EXPECT_LE(worst(fresh.picture(), 3), x == 75 ? 2 : 30) << x;
  }
}

TEST(CleanPlate, FollowsTheLight) {
  Tank tank(1);
  CleanPlate plate(kWidth, kHeight);
  tank.film(-1);
  std::vector<uint8_t> dark(static_cast<std::size_t>(kWidth * kHeight), 10);
  const Picture before{dark.data(), kWidth, kHeight, kWidth, PixelFormat::luma8, 0, 0};
  plate.update(before, {}, {});
  for (int i = 0; i < 25; ++i) plate.update(tank.picture(), {}, {});
  tank.film(75);
  plate.update(tank.picture(), tank.mask(), {});
  EXPECT_LE(worst(plate.picture(), 1), 4);
}

TEST(CleanPlate, LearnsAheadWhereTheClipCanBeRewound) {
  const auto camera = open_camera(parse_camera_spec("sim:scene=turns,seed=1,size=320x180,frames=240"), {}, 0);
  CleanPlate plate(320, 180);
  plate.learn(*camera);
  ASSERT_TRUE(camera->next());
  std::vector<uint64_t> everything(static_cast<std::size_t>(words_for(320) * 180), ~uint64_t{0});
  plate.update(camera->picture(), {everything.data(), 320, 180, words_for(320)}, {});
  const Picture camera_picture = camera->picture();  // of the empty tank: the fish comes later
  double off = 0;
  const int bytes = camera_picture.width * camera_picture.height * (camera_picture.format == PixelFormat::rgb8 ? 3 : 1);
  for (int i = 0; i < bytes; ++i) off += std::abs(plate.picture().pixels[i] - camera_picture.pixels[i]);
  EXPECT_LT(off / bytes, 4);
}

TEST(CleanPlate, AllocatesNothingAfterTheFirstPicture) {
  if (!heap_count_available()) GTEST_SKIP() << "allocations cannot be counted in this build";
  Tank tank(3);
  CleanPlate plate(kWidth, kHeight);
  tank.film(30);
  const HeapCount heap;
  for (int i = 0; i < 5; ++i) plate.update(tank.picture(), tank.mask(), {});
  EXPECT_EQ(heap.allocations(), 0);
}

TEST(CleanPlate, AnotherSizeIsIgnored) {
  Tank tank(1);
  tank.film(-1);
  CleanPlate plate(64, 40);
  plate.update(tank.picture(), {}, {});
  EXPECT_EQ(plate.picture().pixels, nullptr);
}

}  // namespace
}  // namespace nt
