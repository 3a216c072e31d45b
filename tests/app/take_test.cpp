// SPDX-License-Identifier: Apache-2.0
#include "app/take/take.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "app/take/take_row.h"
#include "tests/app/take_frames.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

std::vector<TakeFrame> test_frames(int count, int fish = 0) {
  std::vector<TakeFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(test_take_frame(i, fish));
  return frames;
}

void make_take(const std::string& path, int count) {
  Take take = Take::create(path, test_take_info());
  take.append(test_frames(count));
  take.close();
}

std::vector<std::byte> row_of(const TakeFrame& frame) {
  std::vector<std::byte> row;
  write_take_row(frame, row);
  return row;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Take, ReadsBackEveryNumber) {
  const TempDir dir;
  make_take(dir / "a.take", 50);
  EXPECT_FALSE(std::filesystem::exists(dir / "a.take-wal"));
  Take take = Take::open(dir / "a.take", Take::Access::read);
  EXPECT_FALSE(take.recovered());
  EXPECT_EQ(take.info().name, "noon");
  EXPECT_EQ(take.info().tags, "carp, test");
  EXPECT_EQ(take.info().source_width, 1920);
  EXPECT_EQ(take.info().fps, 30.0);
  const std::vector<TakeFrame> frames = take.frames(0);
  ASSERT_EQ(frames.size(), 50u);
  for (int i = 0; i < 50; ++i) {
    const TakeFrame& read = frames[static_cast<std::size_t>(i)];
    const TakeFrame written = test_take_frame(i);
    EXPECT_EQ(read.frame, i);
    EXPECT_EQ(read.flags, written.flags);
    EXPECT_EQ(read.motion.time_ns, written.motion.time_ns);
    EXPECT_EQ(read.motion.status, written.motion.status);
    EXPECT_EQ(read.pose.status, written.pose.status);
    EXPECT_EQ(row_of(read), row_of(written)) << i;
    EXPECT_EQ(read.pose.low_axis[14].x, 11.0f);
    EXPECT_EQ(read.pose.confidence.r_fin, 0.6f);
  }
}

TEST(Take, SummarisesSeveralFish) {
  const TempDir dir;
  Take take = Take::create(dir / "a.take", test_take_info());
  take.append(test_frames(30, 0));
  take.append(test_frames(20, 3));
  const TakeSummary summary = take.summary();
  EXPECT_EQ(summary.frames, 30);
  EXPECT_EQ(summary.fish, 2);
  EXPECT_EQ(summary.posed, 30 - 4 + 20 - 3);
  EXPECT_NEAR(summary.seconds, 1.0, 1e-6);
  EXPECT_EQ(take.fish(), (std::vector<int>{0, 3}));
  const std::vector<TakeFrame> other = take.frames(3);  // as long as the take, though its last frames were not recorded
  ASSERT_EQ(other.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(other[i].recorded, i < 20);
}

TEST(Take, TrimNumbersAnew) {
  const TempDir dir;
  make_take(dir / "a.take", 100);
  Take::open(dir / "a.take", Take::Access::edit).trim(10, 80);
  const std::vector<TakeFrame> frames = Take::open(dir / "a.take", Take::Access::read).frames(0);
  ASSERT_EQ(frames.size(), 71u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame, static_cast<int64_t>(i));
    EXPECT_EQ(frames[i].motion.centre.x, static_cast<float>(i + 10));
  }
}

TEST(Take, InfoCanBeChanged) {
  const TempDir dir;
  make_take(dir / "a.take", 5);
  TakeInfo info = test_take_info();
  info.name = "evening 'light'", info.notes = "two\nlines";
  Take::open(dir / "a.take", Take::Access::edit).set_info(info);
  const Take take = Take::open(dir / "a.take", Take::Access::read);
  EXPECT_EQ(take.info().name, "evening 'light'");
  EXPECT_EQ(take.info().notes, "two\nlines");
  EXPECT_EQ(take.info().camera, "sim:scene=calm");
}

TEST(Take, KeepsAnEditList) {
  const TempDir dir;
  make_take(dir / "a.take", 5);
  const std::vector<std::string> lines{"set head_angle 3 1.5", "trim 1:3"};
  Take::open(dir / "a.take", Take::Access::edit).set_edits({"retime 2"});
  Take::open(dir / "a.take", Take::Access::edit).set_edits(lines);
  Take take = Take::open(dir / "a.take", Take::Access::read);
  EXPECT_EQ(take.edits(), lines);
  EXPECT_EQ(take.frames(0).size(), 5u);  // the recording itself is not touched
}

TEST(Take, NeverWritesOverAFile) {
  const TempDir dir;
  make_take(dir / "a.take", 5);
  EXPECT_NE(user_error([&] { Take::create(dir / "a.take", test_take_info()); }).find("never overwritten"),
            std::string::npos);
  EXPECT_EQ(Take::open(dir / "a.take", Take::Access::read).frames(0).size(), 5u);
}

TEST(Take, TwoWritersAreRefused) {
  const TempDir dir;
  Take first = Take::create(dir / "a.take", test_take_info());
  const std::string line = user_error([&] { Take::open(dir / "a.take", Take::Access::edit); });
  EXPECT_NE(line.find("in use by another program"), std::string::npos) << line;
  const std::string reader = user_error([&] { Take::open(dir / "a.take", Take::Access::read); });
  EXPECT_NE(reader.find("in use by another program"), std::string::npos) << reader;
  first.append(test_frames(3));
  first.close();
  EXPECT_EQ(Take::open(dir / "a.take", Take::Access::edit).frames(0).size(), 3u);
}

TEST(Take, RefusesWhatIsNoTake) {
  const TempDir dir;
  write_text(dir / "text", std::string(5000, 'x'));
  write_text(dir / "empty", "");
  Database(dir / "other", Database::Mode::create).execute("CREATE TABLE t(x); PRAGMA user_version = 1");
  make_take(dir / "newer", 3);
  Database(dir / "newer", Database::Mode::write).execute("PRAGMA user_version = 99");
  const auto line = [&](const char* name) { return user_error([&] { Take::open(dir / name, Take::Access::read); }); };
  EXPECT_NE(line("text").find("not a take"), std::string::npos) << line("text");
  EXPECT_NE(line("empty").find("not a take"), std::string::npos) << line("empty");
  EXPECT_NE(line("other").find("not a take"), std::string::npos) << line("other");
  EXPECT_NE(line("newer").find("newer neontetra (take version 99"), std::string::npos) << line("newer");
  EXPECT_NE(line("missing").find("no such take"), std::string::npos) << line("missing");
  EXPECT_NE(line(".").find("no such take"), std::string::npos) << line(".");
}

TEST(Take, DamagedPagesAreRefusedAndRepaired) {
  const TempDir dir;
  make_take(dir / "a.take", 2000);
  std::string bytes = read_file(dir / "a.take");
  const std::size_t middle = bytes.size() / 2 / 4096 * 4096;
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(middle), 4096, '\xff');
  write_text(dir / "b.take", bytes);
  const std::string line = user_error([&] { Take::open(dir / "b.take", Take::Access::read); });
  EXPECT_NE(line.find("takes --repair"), std::string::npos) << line;
  const int64_t saved = repair_take(dir / "b.take", dir / "c.take");
  EXPECT_GT(saved, 1900);
  EXPECT_LT(saved, 2000);
  const std::vector<TakeFrame> frames = Take::open(dir / "c.take", Take::Access::read).frames(0);
  EXPECT_EQ(std::count_if(frames.begin(), frames.end(), [](const TakeFrame& frame) { return frame.recorded; }), saved);
  for (const TakeFrame& frame : frames) {
    if (!frame.recorded) continue;
    EXPECT_EQ(row_of(frame), row_of(test_take_frame(frame.frame)));
  }
}

TEST(Take, OneThatEndsEarlyIsRepairedUpToThere) {
  const TempDir dir;
  make_take(dir / "a.take", 2000);
  const std::string whole = read_file(dir / "a.take");
  for (const std::size_t missing : {whole.size() / 50, whole.size() / 50 / 4096 * 4096, whole.size() / 20}) {
    write_text(dir / "b.take", whole.substr(0, whole.size() - missing));
    std::filesystem::remove(dir / "c.take");
    EXPECT_GT(repair_take(dir / "b.take", dir / "c.take"), 1500) << missing;
    EXPECT_FALSE(std::filesystem::exists(dir / "c.take.part"));
    for (const TakeFrame& frame : Take::open(dir / "c.take", Take::Access::read).frames(0)) {
      if (!frame.recorded) continue;
      EXPECT_EQ(row_of(frame), row_of(test_take_frame(frame.frame)));
    }
  }
}

// Bytes thrown in and a file cut anywhere: refused with one line, or read; never a crash, never a number out of range.
TEST(Take, SurvivesAnyDamage) {
  const TempDir dir;
  make_take(dir / "a.take", 200);
  const std::string good = read_file(dir / "a.take");
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    std::string bytes = good;
    if (round % 4 == 0) bytes.resize(random() % bytes.size());
    for (unsigned long hits = random() % 20; hits > 0 && !bytes.empty(); --hits)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    write_text(dir / "b.take", bytes);
    const std::string line = user_error([&] {
      Take take = Take::open(dir / "b.take", Take::Access::read);
      take.summary();
      for (const int fish : take.fish()) {
        for (const TakeFrame& frame : take.frames(fish)) ASSERT_LE(frame.motion.l_num, kMaxLowAxis);
      }
    });
    refused += !line.empty();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    if (round % 8 != 0) continue;  // repairing waits for the disk
    std::filesystem::remove(dir / "c.take");
    user_error([&] { repair_take(dir / "b.take", dir / "c.take"); });
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace nt
