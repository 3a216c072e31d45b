// SPDX-License-Identifier: Apache-2.0
#include "app/export/video_writer.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <csignal>
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <random>

#include "tests/support/small_disk.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

void write_clip(const std::string& path, int frames, double fps, int width = kWidth, int height = kHeight) {
  VideoWriter writer(path, width, height, fps);
  for (int n = 0; n < frames; ++n) writer.add(ramp_frame(width, height, n));
  writer.finish();
  EXPECT_EQ(writer.frames_written(), frames);
}

struct Clip {
  int frames = 0;
  double fps = 0;
  double worst = 0;  // largest mean absolute difference of a frame's luma
  cv::Size size;
};

Clip read_clip(const std::string& path, int width = kWidth, int height = kHeight) {
  cv::VideoCapture capture(path, cv::CAP_FFMPEG);
  Clip clip;
  clip.fps = capture.get(cv::CAP_PROP_FPS);
  cv::Mat bgr, got, want;
  while (capture.read(bgr)) {
    std::vector<uint8_t> rgb = ramp_frame(width, height, clip.frames++);
    clip.size = bgr.size();
    cv::cvtColor(bgr, got, cv::COLOR_BGR2GRAY);
    cv::cvtColor(cv::Mat(height, width, CV_8UC3, rgb.data()), want, cv::COLOR_RGB2GRAY);
    cv::Mat difference;
    cv::absdiff(got, want(cv::Rect({0, 0}, bgr.size())), difference);
    clip.worst = std::max(clip.worst, cv::mean(difference)[0]);
  }
  return clip;
}

class EveryContainer : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryContainer, KeepsFramesRateAndPicture) {
  const TempDir dir;
  const std::string path = dir / (std::string("clip") + GetParam());
  const std::string error = user_error([&] { write_clip(path, 40, 29.97); });
  if (error.find("no encoder") != std::string::npos) GTEST_SKIP() << error;
  ASSERT_EQ(error, "");
  const Clip clip = read_clip(path);
  EXPECT_EQ(clip.frames, 40);
  EXPECT_NEAR(clip.fps, 30000.0 / 1001,
              std::string(GetParam()) == ".webm" || std::string(GetParam()) == ".mkv" ? 0.05 : 1e-6);
  EXPECT_EQ(clip.size, cv::Size(kWidth, kHeight));
  EXPECT_LT(clip.worst, 3);
}

INSTANTIATE_TEST_SUITE_P(VideoWriter, EveryContainer,
                         ::testing::Values(".mp4", ".mov", ".mkv", ".avi", ".webm", ".MP4"), [](const auto& chosen) {
                           const std::string name = chosen.param + 1;
                           return std::isupper(static_cast<unsigned char>(name[0])) != 0 ? "upper_case_" + name : name;
                         });

TEST(VideoWriter, KeepsOddRatesAsFractions) {
  const TempDir dir;
  for (const auto& [fps, want] : {std::pair{25.0, 25.0},
                                  {23.976, 24000.0 / 1001},
                                  {59.94, 60000.0 / 1001},
                                  {12.5, 12.5},
                                  {359.0 / 12, 359.0 / 12},
                                  {1000.0, 1000.0}}) {
    write_clip(dir / "rate.mp4", 5, fps, 64, 48);
    EXPECT_NEAR(read_clip(dir / "rate.mp4", 64, 48).fps, want, 1e-6);
  }
}

TEST(VideoWriter, OddSidesLoseTheLastRowAndColumn) {
  const TempDir dir;
  write_clip(dir / "odd.mp4", 5, 30, 161, 121);
  const Clip clip = read_clip(dir / "odd.mp4", 161, 121);
  EXPECT_EQ(clip.size, cv::Size(160, 120));
  EXPECT_LT(clip.worst, 3);
}

TEST(VideoWriter, TheIndexComesFirstSoThatAPlayerCanStartAtOnce) {
  const TempDir dir;
  write_clip(dir / "fast.mp4", 30, 30);
  std::ifstream file(dir / "fast.mp4", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  ASSERT_NE(bytes.find("moov"), std::string::npos);
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST(VideoWriter, LeavesNoReservedTail) {
  const TempDir dir;
  write_clip(dir / "small.mp4", 3, 30, 64, 48);
  EXPECT_LT(std::filesystem::file_size(dir / "small.mp4"), 20000u);
}

TEST(VideoWriter, AFileThatIsNotFinishedByHandStillPlays) {
  const TempDir dir;
  {
    VideoWriter writer(dir / "left.mp4", kWidth, kHeight, 30);
    for (int n = 0; n < 10; ++n) writer.add(ramp_frame(kWidth, kHeight, n));
  }
  EXPECT_EQ(read_clip(dir / "left.mp4").frames, 10);
}

TEST(VideoWriter, EachErrorIsOneClearLine) {
  const TempDir dir;
  const auto opening = [](const std::string& path, int width = 64, int height = 48, double fps = 30) {
    return user_error([&] { VideoWriter(path, width, height, fps); });
  };
  EXPECT_EQ(opening(dir / "no/clip.mp4"),
            "cannot write " + (dir / "no/clip.mp4") + ": there is no folder " + (dir / "no") + "; create it first");
  EXPECT_EQ(opening(dir / "clip.gif"),
            "cannot write " + (dir / "clip.gif") + ": a video's name must end in one of .mp4 .mov .mkv .avi .webm");
  EXPECT_EQ(opening(dir / "clip"),
            "cannot write " + (dir / "clip") + ": a video's name must end in one of .mp4 .mov .mkv .avi .webm");
  std::filesystem::create_directory(dir / "folder.mp4");
  EXPECT_EQ(opening(dir / "folder.mp4"), "cannot write " + (dir / "folder.mp4") + ": Is a directory");
  EXPECT_NE(opening(dir / "clip.mp4", 1, 48).find("1x48 pixels cannot be"), std::string::npos);
  EXPECT_NE(opening(dir / "clip.mp4", 64, 48, 0).find("frame rate"), std::string::npos);
  EXPECT_NE(opening(dir / "clip.mp4", 64, 48, std::nan("")).find("frame rate"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(dir / "clip.mp4"));

  VideoWriter writer(dir / "clip.mp4", 64, 48, 30);
  EXPECT_NE(user_error([&] { writer.add(ramp_frame(32, 48, 0)); }).find("not 64x48"), std::string::npos);
  writer.finish();
  writer.finish();
  EXPECT_NE(user_error([&] { writer.add(ramp_frame(64, 48, 0)); }).find("finished"), std::string::npos);
}

TEST(VideoWriter, AFolderThatMayNotBeWrittenIsNamed) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "locked");
  std::filesystem::permissions(dir / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::others_read |
                                   std::filesystem::perms::owner_exec | std::filesystem::perms::others_exec);
  std::filesystem::permissions(dir.path(), std::filesystem::perms::all);
  const bool root = geteuid() == 0;
  if (root && seteuid(65534) != 0) GTEST_SKIP() << "root writes everywhere";
  const std::string error = user_error([&] { VideoWriter(dir / "locked/clip.mp4", 64, 48, 30); });
  ASSERT_TRUE(!root || seteuid(0) == 0);
  EXPECT_EQ(error, "cannot write " + (dir / "locked/clip.mp4") + ": Permission denied");
}

// Noise does not compress: the file grows by a known kind of amount a frame.
std::vector<uint8_t> noise_frame(std::mt19937& random) {
  std::vector<uint8_t> rgb(kWidth * kHeight * 3);
  for (uint8_t& value : rgb) value = static_cast<uint8_t>(random());
  return rgb;
}

void limit_file_size(const std::string&, rlim_t bytes) {
  const rlimit size{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &size);
}

struct Told {
  std::string line;   // to the user
  int playable = -1;  // frames in the file afterwards
  int status = 0;     // of the child
};

// Fills a file in a child process that has only so much room.
Told fill_up(const std::string& path, void (*confine)(const std::string& folder, rlim_t bytes), rlim_t bytes) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    confine(std::filesystem::path(path).parent_path().string(), bytes);
    std::mt19937 random(1);
    std::string report = user_error([&] {
      VideoWriter writer(path, kWidth, kHeight, 30);
      for (int n = 0; n < 200; ++n) writer.add(noise_frame(random));
      writer.finish();
    });
    report += "|" + std::to_string(read_clip(path).frames);
    const bool sent = write(ends[1], report.data(), report.size()) == static_cast<ssize_t>(report.size());
    std::_Exit(sent ? 0 : 1);
  }
  close(ends[1]);
  std::string report;
  char buffer[256];
  for (ssize_t got; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
    report.append(buffer, static_cast<std::size_t>(got));
  close(ends[0]);
  Told told;
  int status = 0;
  waitpid(child, &status, 0);
  told.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const std::size_t bar = report.rfind('|');
  if (bar == std::string::npos) return told;
  told.line = report.substr(0, bar);
  told.playable = std::atoi(report.c_str() + bar + 1);
  return told;
}

class FullDisk : public ::testing::TestWithParam<const char*> {};

void expect_told(const Told& told, const std::string& path, const std::string& reason) {
  ASSERT_EQ(told.status, 0);
  const std::string start = "cannot write " + path + ": " + reason + "; ";
  ASSERT_EQ(told.line.substr(0, start.size()), start) << told.line;
  const int written = std::atoi(told.line.c_str() + start.size());
  EXPECT_EQ(told.line, start + std::to_string(written) + " frames were written, the file is cut there");
  EXPECT_GT(written, 5);
  EXPECT_LT(written, 200);
  EXPECT_EQ(told.playable, written);
}

TEST_P(FullDisk, IsToldAndWhatWasWrittenPlays) {
  const TempDir dir;
  const std::string path = dir / (std::string("full") + GetParam());
  expect_told(fill_up(path, limit_file_size, 3 << 20), path, "File too large");
  EXPECT_GT(std::filesystem::file_size(path), 2u << 20);
}

TEST_P(FullDisk, IsToldOnARealFileSystemToo) {
  const TempDir dir;
  const std::string path = dir / (std::string("full") + GetParam());
  const Told told = fill_up(path, mount_small_disk, 3 << 20);
  if (told.status == kMayNotMount) GTEST_SKIP() << "this user may not mount a file system of its own";
  expect_told(told, path, "No space left on device");
}

INSTANTIATE_TEST_SUITE_P(VideoWriter, FullDisk, ::testing::Values(".mp4", ".mkv", ".avi"),
                         [](const auto& chosen) { return std::string(chosen.param + 1); });

TEST(VideoWriter, ADeviceWithoutSpaceIsToldAtTheFirstFrame) {
  const TempDir dir;
  std::error_code error;
  std::filesystem::create_symlink("/dev/full", dir / "full.avi", error);
  if (error || !std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const std::string line = user_error([&] { write_clip(dir / "full.avi", 30, 30); });
  EXPECT_EQ(line, "cannot write " + (dir / "full.avi") + ": No space left on device; no frame was written");
}

}  // namespace
}  // namespace nt
