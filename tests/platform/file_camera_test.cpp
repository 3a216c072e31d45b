// SPDX-License-Identifier: Apache-2.0
// Clips made on the spot go through the file camera; damaged ones give one line and every frame that can be had.
#include "platform/sim/file_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "app/export/video_writer.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

void write_clip(const std::string& path, int frames, double fps = 30, int width = kWidth, int height = kHeight) {
  VideoWriter writer(path, width, height, fps);
  for (int n = 0; n < frames; ++n) writer.add(ramp_frame(width, height, n));
  writer.finish();
}

void write_motion_jpeg(const std::string& path, int frames) {
  cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10,
                         {kWidth, kHeight});
  for (int n = 0; n < frames; ++n) {
    std::vector<uint8_t> rgb = ramp_frame(kWidth, kHeight, n);
    cv::Mat bgr;
    cv::cvtColor(cv::Mat(kHeight, kWidth, CV_8UC3, rgb.data()), bgr, cv::COLOR_RGB2BGR);
    writer.write(bgr);
  }
}

// One-channel JPEGs one after the other, as an industrial camera streams them; no header tells how many.
void write_grey_jpegs(const std::string& path, int frames) {
  std::string stream;
  for (int n = 0; n < frames; ++n) {
    std::vector<uint8_t> rgb = ramp_frame(kWidth, kHeight, n), jpeg;
    cv::Mat grey;
    cv::cvtColor(cv::Mat(kHeight, kWidth, CV_8UC3, rgb.data()), grey, cv::COLOR_RGB2GRAY);
    cv::imencode(".jpg", grey, jpeg);
    stream.append(jpeg.begin(), jpeg.end());
  }
  write_text(path, stream);
}

cv::Mat luma_of(const Frame& frame) {
  return cv::Mat(frame.luma.height, frame.luma.width, CV_8UC1, const_cast<uint8_t*>(frame.luma.data),
                 static_cast<std::size_t>(frame.luma.stride));
}

// Mean absolute difference from frame n as it was made, shrunk as the camera shrinks.
double difference(const Frame& frame, int n) {
  std::vector<uint8_t> rgb = ramp_frame(kWidth, kHeight, n);
  cv::Mat grey, shrunk, off;
  cv::cvtColor(cv::Mat(kHeight, kWidth, CV_8UC3, rgb.data()), grey, cv::COLOR_RGB2GRAY);
  cv::resize(grey, shrunk, {frame.luma.width, frame.luma.height}, 0, 0, cv::INTER_AREA);
  cv::absdiff(luma_of(frame), shrunk, off);
  return cv::mean(off)[0];
}

int64_t drain(Camera& camera) {
  int64_t frames = 0;
  while (camera.next()) ++frames;
  return frames;
}

std::string open_error(const std::string& path) {
  return user_error([&] { open_file_camera(path, 960, 544); });
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(FileCamera, GivesBackWhatWasFilmed) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 40, 29.97);
  const auto camera = open_file_camera(dir / "clip.mp4", 960, 544);
  EXPECT_EQ(camera->info().name, "file:" + (dir / "clip.mp4"));
  EXPECT_EQ(camera->info().width, kWidth);
  EXPECT_EQ(camera->info().height, kHeight);
  EXPECT_EQ(camera->info().frame_count, 40);
  EXPECT_NEAR(camera->info().fps, 30000.0 / 1001, 1e-6);
  EXPECT_EQ(camera->picture().pixels, nullptr);
  for (int n = 0; n < 40; ++n) {
    const auto frame = camera->next();
    ASSERT_TRUE(frame.has_value()) << n;
    EXPECT_EQ(frame->sequence, static_cast<uint64_t>(n));
    EXPECT_NEAR(static_cast<double>(frame->timestamp_ns), n * 1001e6 / 30, 1);
    EXPECT_LT(difference(*frame, n), 3) << n;
  }
  EXPECT_FALSE(camera->next().has_value());
  EXPECT_EQ(camera->warning(), "");
}

TEST(FileCamera, PictureIsTheSameFrameInRgb) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 5);
  const auto camera = open_file_camera(dir / "clip.mp4", 960, 544);
  uint64_t revision = 0;
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(camera->next());
    const Picture picture = camera->picture();
    ASSERT_EQ(picture.format, PixelFormat::rgb8);
    EXPECT_NE(picture.revision, revision);
    revision = picture.revision;
    const int x = 4 * n + kWidth / 16, y = kHeight / 2 + kHeight / 16;  // the middle of the red block
    const uint8_t* rgb = picture.pixels + y * picture.stride + 3 * x;
    EXPECT_GT(rgb[0], 220);
    EXPECT_LT(rgb[1], 40);
    EXPECT_LT(rgb[2], 40);
  }
}

TEST(FileCamera, RewindsToTheFirstFrame) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 20);
  const auto camera = open_file_camera(dir / "clip.mp4", 960, 544);
  const cv::Mat first = luma_of(*camera->next()).clone();
  EXPECT_EQ(drain(*camera), 19);
  ASSERT_TRUE(camera->rewind());
  const auto again = camera->next();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sequence, 0u);
  EXPECT_EQ(cv::norm(luma_of(*again), first, cv::NORM_INF), 0);
  EXPECT_EQ(drain(*camera), 19);
}

TEST(FileCamera, FrameRateCanBeOverridden) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 3, 10);
  const auto camera = open_file_camera(dir / "clip.mp4", 960, 544, 500);
  EXPECT_EQ(camera->info().fps, 500);
  camera->next();
  EXPECT_EQ(camera->next()->timestamp_ns, 2000000);
}

TEST(FileCamera, WorkingSizeKeepsTheAspectAndNeverGrows) {
  const auto check = [](int source_w, int source_h, int work_w, int work_h, int want_w, int want_h) {
    const WorkSize size = working_size(source_w, source_h, work_w, work_h);
    EXPECT_EQ(size.width, want_w) << source_w << "x" << source_h;
    EXPECT_EQ(size.height, want_h) << source_w << "x" << source_h;
  };
  check(1920, 1080, 960, 544, 960, 540);
  check(2048, 2048, 960, 544, 544, 544);
  check(640, 360, 960, 544, 640, 360);
  check(961, 544, 960, 544, 960, 543);
  check(1080, 1920, 960, 544, 306, 544);
  check(7680, 4320, 960, 544, 960, 540);
  check(16, 16, 960, 544, 16, 16);
}

TEST(FileCamera, ShrinksByAreaToTheWorkingSize) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 3);
  const auto camera = open_file_camera(dir / "clip.mp4", 100, 100);
  EXPECT_EQ(camera->info().source_width, kWidth);
  const auto frame = camera->next();
  EXPECT_EQ(frame->luma.width, 100);
  EXPECT_EQ(frame->luma.height, 75);
  EXPECT_EQ(camera->picture().width, 100);
  EXPECT_LT(difference(*frame, 0), 3);
}

TEST(FileCamera, FullRangeMotionJpegAndGreyReachBlackAndWhite) {
  const TempDir dir;
  write_motion_jpeg(dir / "clip.avi", 12);
  write_grey_jpegs(dir / "clip.mjpeg", 12);
  for (const char* name : {"clip.avi", "clip.mjpeg"}) {
    const auto camera = open_file_camera(dir / name, 960, 544);
    const auto frame = camera->next();
    EXPECT_LT(difference(*frame, 0), 3) << name;
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(luma_of(*frame), &darkest, &brightest);
    EXPECT_LE(darkest, 3) << name;
    EXPECT_GE(brightest, 252) << name;
    EXPECT_EQ(drain(*camera), 11) << name;
    EXPECT_EQ(camera->warning(), "") << name;
  }
}

TEST(FileCamera, RealFullRangeClipIsNotSqueezed) {
  const std::string path = "../shared/data/fish_topview/sunfish_pectoral_flume.avi";
  const std::string found = std::filesystem::exists(path) ? path : std::string(NEONTETRA_ASSETS) + "/../" + path;
  if (!std::filesystem::exists(found)) GTEST_SKIP() << "the shared clips are not here";
  const auto camera = open_file_camera(found, 960, 544);
  EXPECT_EQ(camera->info().width, 500);
  EXPECT_EQ(camera->info().height, 263);
  double darkest = 255, brightest = 0;
  int frames = 0;
  while (const auto frame = camera->next()) {
    double low = 0, high = 0;
    cv::minMaxLoc(luma_of(*frame), &low, &high);
    darkest = std::min(darkest, low), brightest = std::max(brightest, high);
    ++frames;
  }
  EXPECT_EQ(frames, 120);
  EXPECT_LE(darkest, 4);  // 16 and 235 if the range were taken for the limited one's opposite
  EXPECT_GE(brightest, 253);
  EXPECT_EQ(camera->warning(), "");
}

// Sets the display matrix in the file's track header to a quarter turn: what a phone held upright writes.
void turn_by_flag(const std::string& path) {
  std::string bytes = bytes_of(path);
  const std::size_t at = bytes.find("tkhd");
  ASSERT_NE(at, std::string::npos);
  const std::size_t matrix = at + 4 + 40;
  const uint32_t turned[9] = {0, 0x10000, 0, 0xFFFF0000u, 0, 0, static_cast<uint32_t>(kHeight) << 16, 0, 0x40000000};
  for (std::size_t i = 0; i < 36; ++i) bytes[matrix + i] = static_cast<char>(turned[i / 4] >> (24 - 8 * (i % 4)));
  write_text(path, bytes);
}

TEST(FileCamera, AppliesTheRotationFlag) {
  const TempDir dir;
  write_clip(dir / "clip.mp4", 4);
  turn_by_flag(dir / "clip.mp4");
  const auto camera = open_file_camera(dir / "clip.mp4", 960, 544);
  EXPECT_EQ(camera->info().source_width, kHeight);
  EXPECT_EQ(camera->info().source_height, kWidth);
  const cv::Mat luma = luma_of(*camera->next());
  EXPECT_LT(luma.at<uint8_t>(4, kHeight / 4), 20);            // the ramp's black end is up
  EXPECT_GT(luma.at<uint8_t>(kWidth - 4, kHeight / 4), 235);  // its white end down
}

class PictureFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int n = 1; n <= 12; ++n) save(n, n);
    write_text(dir_ / "notes.txt", "no picture");
  }
  void save(int number, int level, cv::Size size = {64, 48}) {
    cv::imwrite(dir_ / ("frame_" + std::to_string(number) + ".png"), cv::Mat(size, CV_8UC1, cv::Scalar(level * 10)));
  }
  static std::vector<int> levels(Camera& camera) {
    std::vector<int> out;
    while (const auto frame = camera.next()) out.push_back(frame->luma.data[0] / 10);
    return out;
  }
  TempDir dir_;
  const std::vector<int> all_ = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
};

TEST_F(PictureFolder, GoesInNaturalOrderHoweverItIsNamed) {
  for (const std::string& path : {dir_.path(), dir_ / "frame_%d.png", dir_ / "frame_*.png"}) {
    const auto camera = open_file_camera(path, 960, 544);
    EXPECT_EQ(camera->info().frame_count, 12);
    EXPECT_EQ(camera->info().fps, 25);
    EXPECT_EQ(levels(*camera), all_) << path;
    EXPECT_TRUE(camera->rewind());
    EXPECT_EQ(levels(*camera), all_) << path;
  }
}

TEST_F(PictureFolder, PaddedPatternTakesPaddedNames) {
  cv::imwrite(dir_ / "shot_0007.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(70)));
  cv::imwrite(dir_ / "shot_0010.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(100)));
  EXPECT_EQ(levels(*open_file_camera(dir_ / "shot_%04d.png", 960, 544)), (std::vector<int>{7, 10}));
}

TEST_F(PictureFolder, OnePictureIsAClipOfOneFrame) {
  const auto camera = open_file_camera(dir_ / "frame_5.png", 960, 544);
  EXPECT_EQ(levels(*camera), std::vector<int>{5});
}

TEST_F(PictureFolder, ADamagedPictureIsPassedOverAndTold) {
  const std::string whole = bytes_of(dir_ / "frame_6.png");
  write_text(dir_ / "frame_6.png", whole.substr(0, 40));
  const auto camera = open_file_camera(dir_ / "frame_%d.png", 960, 544);
  std::vector<uint64_t> numbers;
  while (const auto frame = camera->next()) numbers.push_back(frame->sequence);
  EXPECT_EQ(numbers, (std::vector<uint64_t>{0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(camera->warning(), "frame_%d.png: 1 of 12 frames could not be decoded and were skipped");
}

TEST_F(PictureFolder, PicturesOfTwoSizesAreAnError) {
  save(7, 7, {32, 48});
  const auto camera = open_file_camera(dir_.path(), 960, 544);
  EXPECT_NE(user_error([&] { drain(*camera); }).find("frame 6 is 32x48 pixels, the first was 64x48"),
            std::string::npos);
}

TEST(FileCamera, ATruncatedFileGivesItsFramesAndAWarning) {
  const TempDir dir;
  write_clip(dir / "whole.mp4", 60);
  write_motion_jpeg(dir / "whole.avi", 60);
  for (const std::string extension : {"mp4", "avi"}) {
    const std::string whole = bytes_of(dir / ("whole." + extension));
    write_text(dir / ("clip." + extension), whole.substr(0, whole.size() / 2));
    const auto camera = open_file_camera(dir / ("clip." + extension), 960, 544);
    int64_t frames = 0;
    while (const auto frame = camera->next()) {
      if (frames < 10) {
        EXPECT_LT(difference(*frame, static_cast<int>(frames)), 3) << extension << frames;
      }
      ++frames;
    }
    EXPECT_GT(frames, 10) << extension;
    EXPECT_LT(frames, 45) << extension;
    EXPECT_EQ(camera->warning(),
              "clip." + extension + ": the file ends early: " + std::to_string(frames) + " of 60 frames could be read");
  }
}

TEST(FileCamera, ADamagedMiddleDoesNotEndTheClip) {
  const TempDir dir;
  write_motion_jpeg(dir / "whole.avi", 30);
  std::string bytes = bytes_of(dir / "whole.avi");
  std::size_t at = 0;
  for (int n = 0; n <= 10; ++n) at = bytes.find("\xFF\xD8\xFF", at + 1);  // the eleventh picture
  ASSERT_NE(at, std::string::npos);
  for (std::size_t i = 0; i < 1500; ++i) bytes[at + i] = 0;
  write_text(dir / "clip.avi", bytes);
  const auto camera = open_file_camera(dir / "clip.avi", 960, 544);
  int64_t last = -1, frames = 0;
  while (const auto frame = camera->next()) {
    ++frames;
    last = static_cast<int64_t>(frame->sequence);
    if (last != 10) {
      EXPECT_LT(difference(*frame, static_cast<int>(last)), 3) << last;
    }
  }
  EXPECT_EQ(last, 29);
  EXPECT_GE(frames, 29);
  const char* lost_one = "clip.avi: 1 of 30 frames could not be decoded and were skipped";
  EXPECT_EQ(camera->warning(), frames == 29 ? lost_one : "");
}

TEST(FileCamera, WhatIsNoClipIsOneLine) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "empty");
  write_text(dir / "zero.mp4", "");
  write_text(dir / "text.mp4", "this is not a video\n");
  write_text(dir / "text.txt", "nor is this\n");
  write_clip(dir / "whole.mp4", 30);
  write_text(dir / "head.mp4", bytes_of(dir / "whole.mp4").substr(0, 40));
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(open_error(dir / "none.mp4"), (dir / "none.mp4") + ": no such file; check the path");
  EXPECT_EQ(open_error(dir / "empty"),
            (dir / "empty") + ": there is no picture in this folder; give one that holds .png or .jpg frames");
  EXPECT_EQ(open_error(dir / "no_%d.png"), (dir / "no_%d.png") + ": no picture matches this pattern; check the path");
  EXPECT_EQ(open_error(dir / "no*.png"), (dir / "no*.png") + ": no picture matches this pattern; check the path");
  EXPECT_EQ(open_error(dir / "zero.mp4"), (dir / "zero.mp4") + ": the file is empty; record it again");
  for (const char* name : {"text.mp4", "text.txt", "head.mp4"}) {
    const std::string error = open_error(dir / name);
    EXPECT_EQ(error.find((dir / name) + ": not a video or picture that can be read"), 0u) << error;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(FileCamera, SizesFromOnePixelTo8K) {
  const TempDir dir;
  cv::imwrite(dir / "dot.png", cv::Mat(1, 1, CV_8UC3, cv::Scalar(1, 2, 3)));
  cv::imwrite(dir / "flat.png", cv::Mat(15, 400, CV_8UC3, cv::Scalar(1, 2, 3)));
  cv::imwrite(dir / "8k.png", cv::Mat(4320, 7680, CV_8UC1, cv::Scalar(90)));
  cv::imwrite(dir / "wide.png", cv::Mat(20, 8193, CV_8UC1, cv::Scalar(90)));
  cv::imwrite(dir / "thin.png", cv::Mat(20, 8192, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(open_error(dir / "dot.png"),
            (dir / "dot.png") + ": its frames are 1x1 pixels, too small to hold a fish; use 16x16 or more");
  EXPECT_NE(open_error(dir / "flat.png").find("400x15 pixels, too small to hold a fish"), std::string::npos);
  EXPECT_NE(open_error(dir / "wide.png").find("8193x20 pixels, too large"), std::string::npos);
  EXPECT_NE(open_error(dir / "thin.png").find("at the working size it is 960x2 pixels, too small"), std::string::npos);
  const auto camera = open_file_camera(dir / "8k.png", 960, 544);
  const auto frame = camera->next();
  EXPECT_EQ(frame->luma.width, 960);
  EXPECT_EQ(frame->luma.height, 540);
  EXPECT_EQ(frame->luma.row(539)[959], 90);
}

TEST(FileCamera, ANameWithAColonIsAFile) {
  const TempDir dir;
  write_clip(dir / "12:30:05.mp4", 3);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(dir.path());
  const std::string error = open_error("12:30:05.mp4");
  std::filesystem::current_path(before);
  EXPECT_EQ(error, "");
}

}  // namespace
}  // namespace nt
