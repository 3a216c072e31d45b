// SPDX-License-Identifier: Apache-2.0
// The camera's pictures beside a take: for every frame its own, whatever was looked at before, and one line where there is none.
#include "app/take_edit/kept_video.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>

#include "app/export/video_writer.h"
#include "app/take_edit/edited_clip.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

constexpr int kFrames = 150, kBits = 8, kBar_px = 20, kWidth = kBits * kBar_px, kHeight = 32;

// Frame n shows n as eight bars, black and white.
void write_numbers(const std::string& path, int frames = kFrames) {
  VideoWriter writer(path, kWidth, kHeight, 30);
  std::vector<uint8_t> rgb(static_cast<std::size_t>(kWidth * kHeight * 3));
  for (int n = 0; n < frames; ++n) {
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      const int bar = static_cast<int>(i / 3) % kWidth / kBar_px;
      rgb[i] = (n >> bar & 1) != 0 ? 235 : 20;
    }
    writer.add(rgb);
  }
  writer.finish();
}

int number_in(const Picture& picture) {
  int number = 0;
  const int bar_px = picture.width / kBits;
  for (int bar = 0; bar < kBits; ++bar) {
    const int x = bar * bar_px + bar_px / 2;
    const uint8_t level = picture.pixels[picture.height / 2 * picture.stride + 3 * x];
    number |= (level > 128 ? 1 : 0) << bar;
  }
  return number;
}

// False when neither a picture of the frame nor a problem comes.
bool wait_for(KeptVideo& video, int64_t frame) {
  video.want(frame);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end) {
    (void)video.picture();
    if (video.shown() == frame || !video.problem().empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(KeptVideo, ShowsThePictureOfTheFrame) {
  const TempDir dir;
  write_numbers(dir / "a.take.mkv");
  KeptVideo video(dir / "a.take.mkv", 0);
  std::vector<int64_t> frames = {0, 1, 2, 3, 149, 148, 60, 59, 61, 120, 10, 10, 0};
  std::minstd_rand random(1);
  for (int i = 0; i < 30; ++i) frames.push_back(static_cast<int64_t>(random() % kFrames));
  for (const int64_t frame : frames) {
    ASSERT_TRUE(wait_for(video, frame)) << frame;
    EXPECT_EQ(video.problem(), "");
    EXPECT_EQ(number_in(video.picture()), frame);
  }
}

TEST(KeptVideo, BeginsLaterThanTheTakeOrBeforeIt) {
  const TempDir dir;
  write_numbers(dir / "a.take.mkv");
  KeptVideo later(dir / "a.take.mkv", 12), before(dir / "a.take.mkv", -12);
  ASSERT_TRUE(wait_for(later, 11));
  EXPECT_EQ(later.problem(), "a.take.mkv begins later");
  ASSERT_TRUE(wait_for(later, 20));
  EXPECT_EQ(number_in(later.picture()), 8);
  EXPECT_EQ(later.problem(), "");
  ASSERT_TRUE(wait_for(before, 20));
  EXPECT_EQ(number_in(before.picture()), 32);
  ASSERT_TRUE(wait_for(before, 140));
  EXPECT_EQ(before.problem(), "a.take.mkv has no picture of this frame");
  ASSERT_TRUE(wait_for(before, 137));
  EXPECT_EQ(number_in(before.picture()), 149);
}

TEST(KeptVideo, WhatIsMissingOrBrokenIsOneLine) {
  const TempDir dir;
  KeptVideo missing(dir / "a.take.mkv", 0);
  ASSERT_TRUE(wait_for(missing, 3));
  EXPECT_EQ(missing.problem(), "a.take.mkv is not there: put it beside the take again");
  EXPECT_EQ(missing.picture().pixels, nullptr);
  write_numbers(dir / "a.take.mkv");  // it is put there again
  ASSERT_TRUE(wait_for(missing, 4));
  EXPECT_EQ(missing.problem(), "");
  EXPECT_EQ(number_in(missing.picture()), 4);

  std::ofstream(dir / "text.mkv") << "this is no video";
  KeptVideo text(dir / "text.mkv", 0);
  ASSERT_TRUE(wait_for(text, 0));
  EXPECT_NE(text.problem().find("text.mkv cannot be read"), std::string::npos) << text.problem();
  EXPECT_EQ(text.problem().find('\n'), std::string::npos);

  // Cut in the middle: what is there is shown.
  std::filesystem::copy_file(dir / "a.take.mkv", dir / "cut.mkv");
  std::filesystem::resize_file(dir / "cut.mkv", std::filesystem::file_size(dir / "cut.mkv") / 2);
  KeptVideo cut(dir / "cut.mkv", 0);
  ASSERT_TRUE(wait_for(cut, 5));
  EXPECT_EQ(number_in(cut.picture()), 5);
  ASSERT_TRUE(wait_for(cut, 149));
  EXPECT_FALSE(cut.problem().empty());
}

TEST(KeptVideo, AHandThatScrubsIsNotWaitedFor) {
  const TempDir dir;
  write_numbers(dir / "a.take.mkv");
  KeptVideo video(dir / "a.take.mkv", 0);
  for (int64_t i = 0; i < 3000; ++i) {
    video.want((i * 37) % kFrames);
    const Picture picture = video.picture();
    if (picture.pixels != nullptr) {
      EXPECT_EQ(number_in(picture), video.shown());
    }
  }
  ASSERT_TRUE(wait_for(video, 77));  // only what is wanted last has to come
  EXPECT_EQ(number_in(video.picture()), 77);
}

// What `capture --keep-video` wrote is found from the take, also when the take is trimmed.
TEST(KeptVideo, BelongsToItsTake) {
  const TempDir dir;
  const std::string path = dir / "b.take";
  ASSERT_EQ(
      neontetra("capture -c sim:scene=calm,seed=1,size=320x180 --frames 90 --background vibe --keep-video --take " +
                path)
          .exit_code,
      0);
  const auto load = [&] {
    Take take = Take::open(path, Take::Access::edit);
    return load_clip(take, path, -1);
  };
  const EditedClip whole = load();
  EXPECT_EQ(whole.video, path + ".mkv");
  EXPECT_EQ(whole.video_first, 0);
  ASSERT_EQ(neontetra("takes --trim 20:80 " + path).exit_code, 0);
  const EditedClip trimmed = load();
  EXPECT_EQ(trimmed.video_first, -20);
  KeptVideo a(whole.video, whole.video_first), b(trimmed.video, trimmed.video_first);
  ASSERT_TRUE(wait_for(a, 30) && wait_for(b, 10));
  const Picture one = a.picture(), other = b.picture();
  ASSERT_EQ(one.width, other.width);
  ASSERT_TRUE(one.pixels != nullptr && other.pixels != nullptr);
  EXPECT_TRUE(std::equal(one.pixels, one.pixels + one.height * one.stride, other.pixels));
  ASSERT_TRUE(wait_for(b, 11));
  const Picture next = b.picture();
  EXPECT_FALSE(std::equal(one.pixels, one.pixels + one.height * one.stride, next.pixels));
}

}  // namespace
}  // namespace nt
