// SPDX-License-Identifier: Apache-2.0
// A take as each version has stored it must open for ever. tests/app/stored/version-1.take is what version 1 wrote: 30 frames of
// the tank's `turns`, with two edits.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/take/edited.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

const std::string kStored = NEONTETRA_SOURCES "/tests/app/stored/version-1.take";

// Of frame 11, read from the file by SQLite and the table of docs/FORMATS.md alone.
constexpr int64_t kTime_ns = 3366666667;
constexpr float kCentreX = 219.654633f, kDir = 2.56818438f, kAngle = -1.32858634f, kTailY = 108.870285f;

// A copy: what is in the repository is never opened for writing.
class StoredTake : public testing::Test {
 protected:
  StoredTake() : path_(dir_ / "v1.take") { std::filesystem::copy_file(kStored, path_); }
  TempDir dir_;
  std::string path_;
};

TEST_F(StoredTake, Version1Opens) {
  Take take = Take::open(path_, Take::Access::read);
  EXPECT_FALSE(take.recovered());
  const TakeInfo& info = take.info();
  EXPECT_EQ(info.name, "stored in version 1");
  EXPECT_EQ(info.tags, "kept,for ever");
  EXPECT_EQ(info.notes, "made by neontetra as of November 2026");
  EXPECT_EQ(info.camera, "sim:scene=turns");
  EXPECT_EQ(info.width, 480);
  EXPECT_EQ(info.source_height, 272);
  EXPECT_EQ(info.fps, 30);
  EXPECT_EQ(info.video, "");
  EXPECT_EQ(info.px_per_mm, 0);
  EXPECT_TRUE(take.thumbnails().empty());
  EXPECT_EQ(take.edits(), (std::vector<std::string>{"set tail_angle 10 -1.2", "smooth path 0:29 6"}));
  const TakeSummary summary = take.summary();
  EXPECT_EQ(summary.frames, 30);
  EXPECT_EQ(summary.posed, 30);
  EXPECT_EQ(summary.fish, 1);
  const std::vector<TakeFrame> frames = take.frames(0);
  ASSERT_EQ(frames.size(), 30u);
  EXPECT_EQ(frames[11].motion.time_ns, kTime_ns);
  EXPECT_FLOAT_EQ(frames[11].motion.centre.x, kCentreX);
  EXPECT_FLOAT_EQ(frames[11].motion.dir_rad, kDir);
  EXPECT_FLOAT_EQ(frames[11].motion.low_axis_angle[7], kAngle);
  EXPECT_FLOAT_EQ(frames[11].pose.tail.y, kTailY);
}

TEST_F(StoredTake, Version1IsPlayedAndChanged) {
  const EditedTake edited = load_take(path_, -1, true);
  EXPECT_FLOAT_EQ(edited.clip.motions[10].tail_angle, -1.2f);
  EXPECT_NE(neontetra("takes --trim 5:24 " + path_).exit_code, 0);  // its edits are of frames that would be gone
  EXPECT_EQ(neontetra("edit --clear " + path_).exit_code, 0);
  EXPECT_EQ(neontetra("takes --trim 5:24 --name other " + path_).exit_code, 0);
  EXPECT_EQ(neontetra("export " + path_ + " --to csv --out " + (dir_ / "a.csv")).exit_code, 0);
  Take take = Take::open(path_, Take::Access::read);
  EXPECT_EQ(take.info().name, "other");
  EXPECT_EQ(take.frames(0).size(), 20u);
}

}  // namespace
}  // namespace nt
