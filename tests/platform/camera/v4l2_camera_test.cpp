// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_camera.h"

#include <gtest/gtest.h>

#include "tests/platform/camera/open_fake.h"

namespace nt {
namespace {

using test::failure_of;
using test::FakeVideo;
using test::open_fake;
using test::Said;

bool shows(const Frame& frame, uint32_t n) {
  for (int y = 0; y < frame.luma.height; ++y) {
    for (int x = 0; x < frame.luma.width; ++x) {
      if (frame.luma.row(y)[x] != FakeVideo::luma_at(x, y, n)) return false;
    }
  }
  return true;
}

V4l2Settings with_format(VideoFormat format) {
  V4l2Settings settings;
  settings.wish.format = format;
  return settings;
}

TEST(V4l2Camera, GivesTheLumaOfEveryRawFormat) {
  FakeVideo video;
  for (const uint32_t fourcc : {V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_GREY})
    video.formats[fourcc] = video.formats[V4L2_PIX_FMT_YUYV];
  for (const VideoFormat format : {VideoFormat::yuyv, VideoFormat::nv12, VideoFormat::grey}) {
    const auto camera = open_fake(video, with_format(format));
    EXPECT_TRUE(camera->info().live);
    for (uint32_t n = 0; n < 20; ++n) {
      const std::optional<Frame> frame = camera->next();
      ASSERT_TRUE(frame);
      EXPECT_TRUE(shows(*frame, n)) << to_string(format) << " " << n;
      EXPECT_EQ(frame->sequence, n);
      EXPECT_NEAR(static_cast<double>(frame->timestamp_ns), n * 1e9 / 30, 3000);
    }
  }
  EXPECT_EQ(video.open_files, 0);
  EXPECT_EQ(video.mappings, 0);
}

TEST(V4l2Camera, GivesChromaOfTwoByTwoBlocks) {
  FakeVideo video;
  video.formats[V4L2_PIX_FMT_NV12] = video.formats[V4L2_PIX_FMT_YUYV];
  for (const VideoFormat format : {VideoFormat::yuyv, VideoFormat::nv12}) {
    const auto camera = open_fake(video, with_format(format));
    EXPECT_TRUE(camera->next()->cb.empty());
    camera->give_chroma();
    const std::optional<Frame> frame = camera->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->cb.width, 32);
    EXPECT_EQ(frame->cb.height, 24);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        ASSERT_EQ(frame->cb.row(y)[x], 90);
        ASSERT_EQ(frame->cr.row(y)[x], 170);
      }
    }
  }
}

TEST(V4l2Camera, ShrinksToTheWorkingSizeAndShowsColours) {
  FakeVideo video;
  const auto camera = open_fake(video, {}, nullptr, 32, 32);
  EXPECT_EQ(camera->info().width, 32);
  EXPECT_EQ(camera->info().height, 24);
  EXPECT_EQ(camera->info().source_width, 64);
  const std::optional<Frame> frame = camera->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->luma.width, 32);
  const Picture picture = camera->picture();
  EXPECT_EQ(picture.width, 32);
  EXPECT_EQ(picture.height, 24);
  EXPECT_EQ(picture.format, PixelFormat::rgb8);
  // Cb 90 and Cr 170: little blue, much red.
  EXPECT_GT(picture.pixels[0], picture.pixels[2] + 50);
}

TEST(V4l2Camera, ChoosesByRateSizeAndFormatAndTakesWhatIsWishedFor) {
  FakeVideo video;
  video.formats = {{V4L2_PIX_FMT_YUYV, {{640, 480, {30}}, {1280, 720, {10}}}},
                   {V4L2_PIX_FMT_MJPEG, {{640, 480, {30}}, {800, 600, {30}}, {1280, 720, {30}}}}};
  const auto size_of = [&](const V4l2Settings& settings) {
    const CameraInfo info = open_fake(video, settings)->info();
    return std::to_string(info.source_width) + "x" + std::to_string(info.source_height) + "@" +
           std::to_string(static_cast<int>(info.fps));
  };
  EXPECT_EQ(size_of({}), "800x600@30");
  EXPECT_EQ(size_of(with_format(VideoFormat::yuyv)), "640x480@30");
  V4l2Settings settings;
  settings.wish.fps = 10;
  settings.wish.width = 1280, settings.wish.height = 720;
  EXPECT_EQ(size_of(settings), "1280x720@10");
  settings.wish.width = 1000;
  const std::string line = failure_of(video, settings);
  EXPECT_NE(line.find("has no 1000x720; it offers yuyv: 640x480 (30 fps), 1280x720 (10 fps); mjpeg: "),
            std::string::npos)
      << line;
}

TEST(V4l2Camera, CountsWhatTheDriverDropped) {
  FakeVideo video;
  const auto camera = open_fake(video);
  (void)camera->next();
  video.advance(500'000'000);  // 15 frames long nobody looked
  uint64_t last = 0, gaps = 0;
  for (int i = 0; i < 10; ++i) {
    const std::optional<Frame> frame = camera->next();
    ASSERT_TRUE(frame);
    EXPECT_TRUE(shows(*frame, static_cast<uint32_t>(frame->sequence)));
    gaps += frame->sequence - last - 1;
    last = frame->sequence;
  }
  EXPECT_GT(gaps, 9u);
  EXPECT_LT(gaps, 16u);
}

TEST(V4l2Camera, SettlesThenLocksThenGivesBack) {
  FakeVideo video;
  video.controls = {{V4L2_CID_EXPOSURE_AUTO, {"Exposure, Auto", 0, 3, V4L2_EXPOSURE_APERTURE_PRIORITY}},
                    {V4L2_CID_EXPOSURE_ABSOLUTE, {"Exposure Time, Absolute", 3, 2047, 250}},
                    {V4L2_CID_AUTO_WHITE_BALANCE, {"White Balance, Automatic", 0, 1, 1}},
                    {V4L2_CID_AUTOGAIN, {"Gain, Automatic", 0, 1, 0}}};
  Said said;
  {
    const auto camera = open_fake(video, {}, &said);
    EXPECT_EQ(video.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
    const std::optional<Frame> frame = camera->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sequence, 0u);  // what settling took is not counted as dropped
    EXPECT_EQ(frame->timestamp_ns, 0);
    EXPECT_GT(video.frames_made, 10u);
    EXPECT_EQ(video.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
    EXPECT_EQ(video.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 250);
    EXPECT_EQ(video.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 0);
    EXPECT_TRUE(said.has("locked: exposure, white balance"));
  }
  EXPECT_EQ(video.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
  EXPECT_EQ(video.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 1);
  V4l2Settings free;
  free.lock = false;
  (void)open_fake(video, free)->next();
  EXPECT_EQ(video.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 1);
}

TEST(V4l2Camera, SetsTheMainsFrequencyOrSaysThatItCannot) {
  FakeVideo video;
  V4l2Settings settings;
  settings.mains = Mains::hz50;
  EXPECT_NE(failure_of(video, settings).find("has no such filter"), std::string::npos);
  video.controls[V4L2_CID_POWER_LINE_FREQUENCY] = {"Power Line Frequency", 0, 2, 2};
  EXPECT_EQ(failure_of(video, settings), "");
  EXPECT_EQ(video.controls[V4L2_CID_POWER_LINE_FREQUENCY].value, V4L2_CID_POWER_LINE_FREQUENCY_50HZ);
}

TEST(V4l2Camera, ComesBackAfterItWasUnplugged) {
  FakeVideo video;
  Said said;
  const auto camera = open_fake(video, {}, &said);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(camera->next());
  video.unplug();
  video.each_wait = [back = video.now_ns() + 2'000'000'000](FakeVideo& v, int64_t now_ns) {
    v.plugged = now_ns > back;
  };
  uint64_t last = 4;
  for (int i = 0; i < 5; ++i) {
    const std::optional<Frame> frame = camera->next();
    ASSERT_TRUE(frame) << camera->failure();
    EXPECT_EQ(frame->sequence > last + 1, i == 0);  // the gap tells what was missed
    last = frame->sequence;
  }
  // Two seconds, and what it takes to notice.
  EXPECT_GE(last, 4u + 60 + 4);
  EXPECT_LE(last, 4u + 60 + 4 + 20);
  EXPECT_TRUE(said.has("was unplugged; plug it in again within 10 s"));
  EXPECT_TRUE(said.has("the camera is back"));
  EXPECT_NE(camera->warning().find("1 times it was unplugged"), std::string::npos);
}

TEST(V4l2Camera, EndsWithALineWhenItDoesNotComeBack) {
  FakeVideo video;
  V4l2Settings settings;
  settings.wait_s = 3;
  const auto camera = open_fake(video, settings);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(camera->next());
  video.unplug();
  EXPECT_FALSE(camera->next());
  EXPECT_FALSE(camera->next());
  EXPECT_EQ(camera->failure(),
            "/dev/video0: the camera was unplugged and did not come back within 3 s; plug it in and start again");
  EXPECT_EQ(video.open_files, 0);
}

TEST(V4l2Camera, IsStartedOnceMoreWhenItFallsSilent) {
  FakeVideo video;
  Said said;
  const auto camera = open_fake(video, {}, &said);
  ASSERT_TRUE(camera->next());
  video.silent = true;
  video.each_wait = [back = video.now_ns() + 2'500'000'000](FakeVideo& v, int64_t now_ns) { v.silent = now_ns < back; };
  ASSERT_TRUE(camera->next());
  EXPECT_TRUE(said.has("no picture for 2 s; starting the camera again"));
  video.each_wait = [](FakeVideo& v, int64_t) { v.silent = true; };
  while (camera->next()) {
  }
  EXPECT_NE(camera->failure().find("though the camera was started again; check the cable, the power"),
            std::string::npos);
}

TEST(V4l2Camera, ReadyDoesNotWait) {
  FakeVideo video;
  const auto camera = open_fake(video);
  ASSERT_TRUE(camera->next());
  const int64_t before_ns = video.now_ns();
  EXPECT_FALSE(camera->ready());
  EXPECT_EQ(video.now_ns(), before_ns);
  video.advance(40'000'000);
  EXPECT_TRUE(camera->ready());
  ASSERT_TRUE(camera->next());
}

TEST(V4l2Camera, EndsWhenTheUserWantsTo) {
  FakeVideo video;
  video.silent = true;
  CameraManners manners;
  int asked = 0;
  manners.stop = [&asked] { return ++asked > 3; };
  const auto camera = open_v4l2_camera({}, 960, 544, 0, manners, video);
  EXPECT_FALSE(camera->next());
  EXPECT_EQ(camera->failure(), "");
}

TEST(V4l2Camera, EachReasonNotToOpenHasItsAdvice) {
  const struct {
    const char* call;
    int error;
    const char* advice;
  } cases[] = {
      {"open", EACCES, "join the group video"},
      {"open", ENOENT, "there is no such camera"},
      {"open", EBUSY, "another program has the camera"},
      {"VIDIOC_S_FMT", EBUSY, "setting the picture format failed (VIDIOC_S_FMT: Device or resource busy); another"},
      {"VIDIOC_REQBUFS", ENOMEM, "choose a smaller size"},
      {"VIDIOC_STREAMON", ENOSPC, "the USB bus cannot carry that much"},
      {"VIDIOC_STREAMON", EIO, "check the cable"},
      {"mmap", ENOMEM, "mapping a picture buffer failed (mmap"}};
  for (const auto& one : cases) {
    FakeVideo video;
    video.fail = [&one](const std::string& call) { return call == one.call ? one.error : 0; };
    const std::string line = failure_of(video);
    EXPECT_NE(line.find(one.advice), std::string::npos) << one.call << ": " << line;
    EXPECT_EQ(line.find("/dev/video0"), 0u) << line;
    EXPECT_EQ(video.open_files, 0);
    EXPECT_EQ(video.mappings, 0);
  }
}

TEST(V4l2Camera, SaysWhatIsNoCamera) {
  FakeVideo video;
  video.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_NE(failure_of(video).find("gives no pictures"), std::string::npos);
  video.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  EXPECT_NE(failure_of(video).find("use libcamera"), std::string::npos);
  video.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  video.formats = {{V4L2_PIX_FMT_RGB24, {{64, 48, {30}}}}};
  EXPECT_NE(failure_of(video).find("'RGB3', which cannot be read"), std::string::npos);
  video.formats = {{V4L2_PIX_FMT_YUYV, {{64, 48, {30}}}}};
  video.most_buffers = 1;
  EXPECT_NE(failure_of(video).find("gives 1 picture buffers, 2 are needed"), std::string::npos);
}

}  // namespace
}  // namespace nt
