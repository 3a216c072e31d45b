// SPDX-License-Identifier: Apache-2.0
// A thousand recordings, of cameras that each fail in some way or on a disk that fills up: no crash, nothing leaked, a line for
// whatever ends one, and nothing lost that is older than a second.
#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "app/take/recorder.h"
#include "tests/platform/camera/full_disk.h"
#include "tests/platform/camera/open_fake.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

using test::FakeVideo;
using test::open_fake;
using test::Said;

constexpr int kFrames = 60;
constexpr const char* kCalls[] = {"open",
                                  "mmap",
                                  "poll",
                                  "VIDIOC_QUERYCAP",
                                  "VIDIOC_ENUM_FMT",
                                  "VIDIOC_ENUM_FRAMESIZES",
                                  "VIDIOC_ENUM_FRAMEINTERVALS",
                                  "VIDIOC_S_FMT",
                                  "VIDIOC_S_PARM",
                                  "VIDIOC_G_CTRL",
                                  "VIDIOC_S_CTRL",
                                  "VIDIOC_REQBUFS",
                                  "VIDIOC_QUERYBUF",
                                  "VIDIOC_QBUF",
                                  "VIDIOC_DQBUF",
                                  "VIDIOC_STREAMON",
                                  "VIDIOC_STREAMOFF"};
constexpr int kErrors[] = {EINTR, EIO,    EAGAIN, EBUSY,  EINVAL, ENODEV, ENXIO,     ENOMEM,
                           EPIPE, EPROTO, EACCES, ENOENT, ENOSPC, ENOTTY, ETIMEDOUT, EMFILE};

std::vector<uint8_t> jpeg_picture(uint32_t n) {
  static const tjhandle coder = tjInitCompress();
  std::vector<uint8_t> rgb(64 * 48 * 3, static_cast<uint8_t>(40 + 5 * (n % 30)));
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(coder, rgb.data(), 64, 0, 48, TJPF_RGB, &bytes, &size, TJSAMP_422, 90, 0);
  std::vector<uint8_t> jpeg(bytes, bytes + size);
  tjFree(bytes);
  return jpeg;
}

struct Plan {
  std::mt19937 random;
  std::string what;
  int pick(int count) { return static_cast<int>(random() % static_cast<uint32_t>(count)); }
};

// Calls fail from the nth on: once, a few times, or for ever.
void plan_call(Plan& plan, FakeVideo& video) {
  const std::string call = kCalls[plan.pick(std::size(kCalls))];
  const int error = kErrors[plan.pick(std::size(kErrors))];
  const int from = plan.pick(2) == 0 ? plan.pick(3) : plan.pick(80);
  const int lengths[] = {1, 3, 40, 1'000'000};
  const int times = lengths[plan.pick(4)];
  plan.what = call + " fails with " + std::to_string(error) + " from " + std::to_string(from) + ", times " +
              std::to_string(times);
  video.fail = [=, count = 0](const std::string& name) mutable {
    if (name != call) return 0;
    const int n = count++;
    return n >= from && n - from < times ? error : 0;
  };
}

// Pictures come short, marked as bad, with bits turned over, from no known buffer, with a clock or a count that jumps.
void plan_picture(Plan& plan, FakeVideo& video) {
  const int kind = plan.pick(7), every = 1 + plan.pick(6);
  plan.what = "picture fault " + std::to_string(kind) + ", one in " + std::to_string(every);
  video.spoil = [kind, every, random = plan.random](v4l2_buffer& buffer, std::vector<uint8_t>& bytes) mutable {
    if (random() % static_cast<uint32_t>(every) != 0) return;
    switch (kind) {
      case 0:
        buffer.bytesused = static_cast<uint32_t>(random() % (bytes.size() + 1));
        break;
      case 1:
        buffer.flags |= V4L2_BUF_FLAG_ERROR;
        break;
      case 2:
        for (int i = 0; i < 8; ++i) bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1u << random() % 8);
        break;
      case 3:
        buffer.index = static_cast<uint32_t>(random() % 40);
        break;
      case 4:
        buffer.timestamp.tv_sec += static_cast<int>(random() % 20000) - 10000;
        break;
      case 5:
        buffer.sequence = static_cast<uint32_t>(random());
        break;
      default:
        buffer.bytesused = 0xffffffffu;
    }
  };
}

// It is unplugged after a while, for ever or not; it falls silent; or the machine is busy for a long time.
void plan_event(Plan& plan, FakeVideo& video) {
  const int kind = plan.pick(4);
  const int64_t from_ns = video.now_ns() + plan.pick(2000) * int64_t{1'000'000};
  const int64_t to_ns = from_ns + plan.pick(15'000) * int64_t{1'000'000};
  plan.what = "event " + std::to_string(kind) + " for " + std::to_string((to_ns - from_ns) / 1'000'000) + " ms";
  video.each_wait = [=, busy = false](FakeVideo& v, int64_t now_ns) mutable {
    const bool during = now_ns >= from_ns && now_ns < to_ns;
    if (kind == 0) v.plugged = !during;
    if (kind == 1) v.plugged = v.plugged && !during;
    if (kind == 2) v.silent = during;
    if (kind == 3 && during && !busy) busy = true, v.advance(to_ns - from_ns);
  };
}

V4l2Settings settle_on(Plan& plan, FakeVideo& video) {
  video.formats[V4L2_PIX_FMT_NV12] = video.formats[V4L2_PIX_FMT_GREY] = {{64, 48, {30}}};
  video.formats[V4L2_PIX_FMT_MJPEG] = {{64, 48, {30}}};
  video.jpeg = jpeg_picture;
  video.controls = {{V4L2_CID_EXPOSURE_AUTO, {"Exposure, Auto", 0, 3, 3}},
                    {V4L2_CID_AUTO_WHITE_BALANCE, {"White Balance, Automatic", 0, 1, 1}},
                    {V4L2_CID_POWER_LINE_FREQUENCY, {"Power Line Frequency", 0, 2, 2}}};
  V4l2Settings settings;
  settings.wish.format = kVideoFormats[plan.pick(4)];
  settings.mains = plan.pick(2) == 0 ? Mains::hz50 : Mains::leave;
  settings.lock = plan.pick(2) == 0;
  return settings;
}

bool is_one_clear_line(const std::string& line) {
  return line.starts_with("/dev/video0") && line.find('\n') == std::string::npos && line.find(';') != std::string::npos;
}

struct Outcome {
  int frames = 0;
  std::string line;  // why it ended early
  std::string warning;
  std::string disk;  // what the recording said
};

// Where frames are recorded; each carries the moment at which it came.
struct Disk {
  std::string path;
  std::unique_ptr<test::FullDisk> full;  // null: large enough
  std::unique_ptr<TakeRecorder> recorder;
};

constexpr int kPeriod_ms = 2;  // short, so that the disk fills up at any moment
constexpr int64_t kSecond_ns = 1'000'000'000;

int64_t real_now_ns() { return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1); }

// Two of three recordings find room enough. An empty file takes some 100,000 bytes.
void plan_disk(Plan& plan, Disk& disk) {
  if (plan.pick(3) == 0) {
    const int bytes = plan.pick(400'000);
    plan.what += "; the disk is full after " + std::to_string(bytes) + " bytes";
    disk.full = std::make_unique<test::FullDisk>(bytes);
  }
}

// "" where it went well.
std::string finish_recording(Disk& disk) {
  std::string line;
  try {
    if (disk.recorder) disk.recorder->finish();
  } catch (const UserError& error) {
    line = error.what();
  }
  disk.recorder.reset();
  return line;
}

// All that was recorded is there, but for a last second where the disk was full.
void expect_kept(Disk& disk, const Outcome& outcome, const std::vector<int64_t>& came_ns, int64_t end_ns) {
  disk.full.reset();
  if (came_ns.empty()) return;
  const std::vector<TakeFrame> kept = Take::open(disk.path, Take::Access::read).frames(0);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].motion.time_ns, came_ns[i]);
  if (outcome.disk.empty()) {
    EXPECT_EQ(kept.size(), came_ns.size());
  }
  if (kept.size() < came_ns.size()) {
    EXPECT_LT(end_ns - came_ns[kept.size()], kSecond_ns);
  }
}

TakeFrame row(int64_t number) {
  TakeFrame frame;
  frame.frame = number;
  frame.motion.time_ns = real_now_ns();
  return frame;
}

Outcome film(FakeVideo& video, const V4l2Settings& settings, Said& said, Disk* disk = nullptr) {
  Outcome outcome;
  std::vector<int64_t> came_ns;
  try {
    const std::unique_ptr<Camera> camera = open_fake(video, settings, &said);
    if (settings.mains == Mains::hz50) camera->give_chroma();
    uint64_t sequence = 0;
    int64_t time_ns = -1;
    for (; outcome.frames < kFrames; ++outcome.frames) {
      const std::optional<Frame> frame = camera->next();
      if (!frame) break;
      EXPECT_TRUE(outcome.frames == 0 || frame->sequence > sequence);
      EXPECT_GT(frame->timestamp_ns, time_ns);
      EXPECT_LT(frame->timestamp_ns, int64_t{3600} * 1'000'000'000);
      sequence = frame->sequence, time_ns = frame->timestamp_ns;
      uint64_t sum = 0;  // every byte can be read
      for (const LumaView& view : {frame->luma, frame->cb, frame->cr}) {
        for (int y = 0; y < view.height; ++y) {
          for (int x = 0; x < view.width; ++x) sum += view.row(y)[x];
        }
      }
      EXPECT_GT(sum, 0u);
      if (outcome.frames % 7 == 0) (void)camera->picture();
      if (disk == nullptr || disk->recorder == nullptr) continue;
      const TakeFrame frame_row = row(outcome.frames);
      disk->recorder->add(frame_row);
      came_ns.push_back(frame_row.motion.time_ns);
    }
    outcome.line = camera->failure();
    outcome.warning = camera->warning();
  } catch (const UserError& error) {
    outcome.line = error.what();
    EXPECT_EQ(error.exit_code, 3);
    EXPECT_EQ(outcome.frames, 0);  // later on, what was filmed is kept
  }
  if (disk == nullptr) return outcome;
  const int64_t end_ns = real_now_ns();
  outcome.disk += finish_recording(*disk);
  expect_kept(*disk, outcome, came_ns, end_ns);
  return outcome;
}

// A disk without room for an empty take says so before the camera is opened.
std::string begin_recording(Disk& disk) {
  TakeInfo info;
  info.name = "fake", info.camera = "v4l2:/dev/video0", info.created = "2026-11-22T09:30:00Z";
  info.source_width = info.width = 64, info.source_height = info.height = 48, info.fps = 30;
  try {
    disk.recorder = std::make_unique<TakeRecorder>(disk.path, info, kPeriod_ms);
    return "";
  } catch (const UserError& error) {
    return error.what();
  }
}

TEST(V4l2Failures, AThousandAtRandom) {
  if (access("/dev/shm", W_OK) == 0) setenv("TMPDIR", "/dev/shm", 1);  // in memory: each file is synchronised often
  int ended = 0, absorbed = 0, never_opened = 0, filled = 0;
  for (uint32_t seed = 0; seed < 1000; ++seed) {
    Plan plan{std::mt19937(seed), ""};
    FakeVideo video;
    const V4l2Settings settings = settle_on(plan, video);
    switch (plan.pick(4)) {
      case 0:
      case 1:
        plan_call(plan, video);
        break;
      case 2:
        plan_picture(plan, video);
        break;
      default:
        plan_event(plan, video);
    }
    const TempDir folder;
    Disk disk{folder / "fake.take", nullptr, nullptr};
    plan_disk(plan, disk);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + plan.what);
    Said said;
    const bool small = disk.full != nullptr;
    const std::string refused = begin_recording(disk);
    const Outcome outcome = film(video, settings, said, refused.empty() ? &disk : nullptr);
    for (const std::string& line : {refused, outcome.disk}) {
      if (line.empty()) continue;
      ++filled;
      EXPECT_TRUE(small) << line;
      EXPECT_NE(line.find("fake.take: the disk is full"), std::string::npos) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
    EXPECT_EQ(video.open_files, 0);
    EXPECT_EQ(video.mappings, 0);
    EXPECT_LT(video.calls_made, 20'000);
    if (outcome.frames < kFrames) {
      EXPECT_TRUE(is_one_clear_line(outcome.line)) << outcome.line;
    } else {
      EXPECT_EQ(outcome.line, "");
    }
    for (const std::string& line : said.lines) EXPECT_EQ(line.find('\n'), std::string::npos);
    ++(outcome.frames == kFrames ? absorbed : outcome.frames > 0 ? ended : never_opened);
    if (HasFailure()) return;
  }
  // All three happen, or the failures were not injected.
  EXPECT_GT(absorbed, 200);
  EXPECT_GT(ended, 50);
  EXPECT_GT(never_opened, 100);
  EXPECT_GT(filled, 50);
  std::printf("%d ridden out, %d ended with a line, %d refused with a line; %d disks were full\n", absorbed, ended,
              never_opened, filled);
}

TEST(V4l2Failures, DamagedPicturesAreCountedAndPassedOver) {
  for (const VideoFormat format : {VideoFormat::mjpeg, VideoFormat::nv12}) {
    Plan plan{std::mt19937(1), ""};
    FakeVideo video;
    V4l2Settings settings = settle_on(plan, video);
    settings.wish.format = format;
    video.spoil = [](v4l2_buffer& buffer, std::vector<uint8_t>& bytes) {
      if (buffer.sequence % 4 == 1) buffer.bytesused = static_cast<uint32_t>(bytes.size() / 2);
    };
    Said said;
    const Outcome outcome = film(video, settings, said);
    EXPECT_EQ(outcome.frames, kFrames);
    EXPECT_NE(outcome.warning.find(" damaged pictures were passed over"), std::string::npos) << outcome.warning;
  }
}

}  // namespace
}  // namespace nt
