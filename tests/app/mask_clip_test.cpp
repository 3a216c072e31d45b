// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/masks/mask_clip.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "platform/camera.h"
#include "tests/bench/masks/mask_model.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

namespace fs = std::filesystem;

cv::Mat grey(int value, int width = 64, int height = 48) {
  return cv::Mat(height, width, CV_8UC3, cv::Scalar::all(value));
}

void write_mask(const std::string& path, int value, int width = 64) {
  cv::imwrite(path, cv::Mat(48, width, CV_8U, cv::Scalar(value)));
}

TEST(MaskClip, PicturesAreMatchedByNumberInNumericalOrder) {
  const TempDir dir;
  fs::create_directories(dir / "pond/input");
  fs::create_directories(dir / "pond/groundtruth");
  for (int k = 1; k <= 11; ++k) {
    cv::imwrite(dir / ("pond/input/frame_" + std::to_string(k) + ".png"), grey(10 * k));
    if (k != 3)
      write_mask(dir / ("pond/groundtruth/gt00" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".png"), k);
  }
  const auto clips = open_masked_clips(dir / "");
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0]->name(), "pond");
  for (int round = 0; round < 2; ++round) {
    MaskedFrame frame;
    for (int k = 1; k <= 11; ++k) {
      ASSERT_TRUE(clips[0]->next(frame));
      EXPECT_EQ(frame.bgr.at<cv::Vec3b>(5, 5)[0], 10 * k);
      EXPECT_EQ(frame.truth.empty(), k == 1 || k == 3) << k << ": the first is only learned, the third has no mask";
      if (!frame.truth.empty()) {
        EXPECT_EQ(frame.truth.at<uint8_t>(5, 5), k);
      }
    }
    EXPECT_FALSE(clips[0]->next(frame));
    clips[0]->rewind();
  }
}

TEST(MaskClip, AVideosMasksAreTwoAhead) {
  const TempDir dir;
  fs::create_directories(dir / "road/groundtruth");
  cv::VideoWriter video(dir / "road/road.avi", cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
  ASSERT_TRUE(video.isOpened());
  for (int n = 0; n < 6; ++n) video.write(grey(40 * n));
  video.release();
  write_mask(dir / "road/groundtruth/gt000005.png", 255);
  const auto clips = open_masked_clips(dir / "");
  ASSERT_EQ(clips.size(), 1u);
  MaskedFrame frame;
  for (int n = 0; n < 6; ++n) {
    ASSERT_TRUE(clips[0]->next(frame));
    EXPECT_EQ(frame.truth.empty(), n != 3) << n;
  }
}

TEST(MaskClip, WhatIsWrongIsSaidInOneLine) {
  const TempDir dir;
  EXPECT_THROW((void)open_masked_clips(dir / "nowhere"), UserError);
  EXPECT_THROW((void)open_masked_clips(dir / ""), UserError) << "no clips";
  fs::create_directories(dir / "pond/input");
  fs::create_directories(dir / "pond/groundtruth");
  for (int k = 1; k <= 2; ++k) {
    cv::imwrite(dir / ("pond/input/frame_" + std::to_string(k) + ".png"), grey(90));
    write_mask(dir / ("pond/groundtruth/gt000" + std::to_string(k) + ".png"), 0, 60);
  }
  const auto clips = open_masked_clips(dir / "");
  MaskedFrame frame;
  EXPECT_TRUE(clips[0]->next(frame));
  EXPECT_THROW((void)clips[0]->next(frame), UserError) << "a mask of another size";
}

TEST(MaskClip, TheTankKnowsItsMask) {
  const auto clip = open_tank_clip("ghost", 40);
  MaskedFrame frame;
  int judged = 0, frames = 0;
  for (; clip->next(frame); ++frames) {
    if (frame.truth.empty()) continue;
    ++judged;
    EXPECT_GT(cv::countNonZero(frame.truth), 4000);
  }
  EXPECT_EQ(frames, 40);
  EXPECT_EQ(judged, 2);
}

// A coloured square enters a noisy grey picture of its own brightness: only the model that sees colour finds it.
TEST(MaskModel, EveryModelMakesMasksOfThePicturesSize) {
  const cv::Size size(161, 97);
  cv::RNG random(3);
  for (const auto& model : make_mask_models(size)) {
    cv::Mat mask;
    double us = -1;
    for (int n = 0; n < 40; ++n) {
      cv::Mat noise(size, CV_8UC3), picture;
      random.fill(noise, cv::RNG::NORMAL, 0, 3);
      cv::add(cv::Mat(size, CV_8UC3, cv::Scalar::all(110)), noise, picture);
      if (n == 39) picture(cv::Rect(60, 40, 30, 20)).setTo(cv::Scalar(20, 118, 143));  // luma 114
      const bool means_something = model->apply(picture, mask, us);
      EXPECT_TRUE(means_something || n == 0) << model->name();
      ASSERT_EQ(mask.size(), size);
      ASSERT_EQ(mask.type(), CV_8U);
      EXPECT_GE(us, 0);
    }
    const int found = cv::countNonZero(mask(cv::Rect(60, 40, 30, 20)));
    if (model->name() == "vibe-colour") {
      EXPECT_EQ(found, 600);
      EXPECT_GT(model->bytes(), 31u * 161 * 97);
    }
    if (model->name() == "vibe") {
      EXPECT_LT(found, 60);
    }
  }
}

}  // namespace
}  // namespace nt
