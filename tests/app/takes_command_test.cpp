// SPDX-License-Identifier: Apache-2.0
// neontetra takes and capture --take, as a user types them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/take/take.h"
#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"
#include "tests/app/take_frames.h"

namespace nt {
namespace {

constexpr const char* kSmallTank = "capture -c sim:scene=calm,size=320x180,frames=120 --seed 1 ";

TEST(TakesCommand, ATakeHoldsWhatTheCsvSays) {
  const TempDir dir;
  const Outcome run = neontetra(kSmallTank + ("--csv " + (dir / "a.csv") + " --take " + (dir / "a.take")));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  Take take = Take::open(dir / "a.take", Take::Access::read);
  const std::vector<TakeFrame> frames = take.frames(0);
  const CsvTable csv(dir / "a.csv");
  ASSERT_EQ(frames.size(), 120u);
  ASSERT_EQ(csv.rows(), 120u);
  const float scale = static_cast<float>(take.info().source_width) / static_cast<float>(take.info().width);
  int posed = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(csv.text(i, "status"), to_string(frames[i].pose.status));
    EXPECT_NEAR(csv.number(i, "t_s").value(), static_cast<double>(frames[i].motion.time_ns) * 1e-9, 1e-6);
    if (!frames[i].pose.ok()) continue;
    ++posed;
    EXPECT_NEAR(csv.number(i, "head_x").value(), (frames[i].pose.head.x + 0.5f) * scale - 0.5f, 1e-3);
    EXPECT_NEAR(csv.number(i, "low_axis_15_y").value(), (frames[i].pose.low_axis[14].y + 0.5f) * scale - 0.5f, 1e-3);
  }
  EXPECT_GT(posed, 20);
  EXPECT_EQ(take.summary().posed, posed);
}

TEST(TakesCommand, ListsRenamesTrimsJoinsAndDeletes) {
  const TempDir dir;
  for (const char* name : {"a.take", "b.take"}) {
    Take take = Take::create(dir / name, test_take_info());
    for (int i = 0; i < 60; ++i) take.append(std::vector<TakeFrame>{test_take_frame(i)});
    take.close();
  }
  EXPECT_EQ(neontetra("takes --name 'calm water' --tags blue " + (dir / "b.take")).exit_code, 0);
  EXPECT_EQ(neontetra("takes --trim 10:29 " + (dir / "b.take")).exit_code, 0);
  // Edits name frames by the numbers that a trim would change.
  write_text(dir / "edits", std::string("set tail_angle 30 -1.2\n"));
  EXPECT_EQ(neontetra("edit " + (dir / "a.take") + " --edits " + (dir / "edits")).exit_code, 0);
  const Outcome edited = neontetra("takes --trim 10:29 " + (dir / "a.take"));
  EXPECT_EQ(edited.exit_code, 1);
  EXPECT_NE(edited.err.find("has 1 edits, which count its frames"), std::string::npos) << edited.err;
  EXPECT_EQ(edited.error_lines(), 1) << edited.err;
  EXPECT_EQ(neontetra("takes --join " + (dir / "c.take") + " " + (dir / "a.take") + " " + (dir / "b.take")).exit_code,
            0);
  const Outcome list = neontetra("takes --json " + dir.path());
  ASSERT_EQ(list.exit_code, 0) << list.err;
  const auto json = nlohmann::json::parse(list.out);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[1]["name"], "calm water");
  EXPECT_EQ(json[1]["tags"], "blue");
  EXPECT_EQ(json[1]["frames"], 20);
  EXPECT_EQ(json[2]["frames"], 80);
  EXPECT_NEAR(json[2]["seconds"].get<double>(), 80.0 / 30, 1e-3);
  EXPECT_EQ(neontetra("takes --delete " + (dir / "a.take")).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(dir / "a.take"));
  EXPECT_TRUE(std::filesystem::exists(dir / ".deleted-takes/a.take"));
}

TEST(TakesCommand, SaysThatARecordingWasRecovered) {
  const TempDir dir;
  {
    Take take = Take::create(dir / "a.take", test_take_info());
    take.append(std::vector<TakeFrame>{test_take_frame(0)});
  }  // not closed: as after a kill
  const Outcome list = neontetra("takes " + dir.path());
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.err.find("cut off; recovered"), std::string::npos) << list.err;
  EXPECT_EQ(neontetra("takes " + dir.path()).err, "");
}

TEST(TakesCommand, EditsAreKeptBesideTheRecordingAndExported) {
  const TempDir dir;
  const std::string take = dir / "a.take";
  ASSERT_EQ(neontetra(kSmallTank + ("--take " + take)).exit_code, 0);
  write_text(dir / "edits", std::string("repair 0:119 0.1\nset tail_angle 60 -1.2\ntrim 30:89\n"));
  const Outcome kept = neontetra("edit " + take + " --edits " + (dir / "edits"));
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_EQ(neontetra("edit " + take + " --list").out, "repair 0:119 0.1\nset tail_angle 60 -1.2\ntrim 30:89\n");
  EXPECT_EQ(neontetra("export " + take + " --to csv --out " + (dir / "a.csv")).exit_code, 0);
  EXPECT_EQ(neontetra("export " + take + " --to csv --recorded --out " + (dir / "b.csv")).exit_code, 0);
  const auto rows = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(rows(read_text(dir / "a.csv")), 63);
  EXPECT_EQ(rows(read_text(dir / "b.csv")), 123);
  const Outcome bvh = neontetra("export " + take + " --to bvh --out -");
  EXPECT_NE(bvh.out.find("Frames: 60\n"), std::string::npos);
  EXPECT_EQ(neontetra("edit " + take + " --clear").exit_code, 0);
  EXPECT_EQ(neontetra("edit " + take + " --list").out, "");
}

TEST(TakesCommand, MistakesAreOneLine) {
  const TempDir dir;
  Take::create(dir / "a.take", test_take_info()).close();
  const std::string a = dir / "a.take";
  const struct {
    std::string arguments, words;
    int exit_code;
  } cases[] = {
      {"takes " + (dir / "none.take"), "no such take", 1},
      {"takes --trim 5 " + a, "expected FIRST:LAST", 2},
      {"takes --trim 9:5 " + a, "expected FIRST:LAST", 2},
      {"takes --trim 5:9 " + a, "would leave none", 1},
      {"takes --join " + (dir / "j.take") + " " + a, "at least two", 2},
      {"takes --join " + a + " " + a + " " + a, "never overwritten", 1},
      {"takes --trim 0:5", "say which", 2},
      {"takes --name other", "say which", 2},
      {"takes --delete", "say which", 2},
      {"takes --thumbnails " + a + " " + a, "would be overwritten", 2},
      {"takes --delete --repair " + a, "one of --trim", 2},
      {"edit " + a, "say one of", 2},
      {"edit " + a + " --edits " + (dir / "none"), "cannot read the edits", 1},
      {"export " + a + " --to csv --out " + (dir / "x.csv"), "the take is empty", 1},
      {"export " + a + " --to fbx --out " + (dir / "x.fbx"), "fbx", 2},
      {"takes --repair " + (dir / "none.take"), "no such take", 1},
      {std::string(kSmallTank) + "--take " + a, "never overwritten", 1},
      {std::string(kSmallTank) + "--csv " + a, "never overwritten", 1},
      {std::string(kSmallTank) + "--take " + (dir / "no/such/folder.take"), "there is no folder", 1},
  };
  for (const auto& mistake : cases) {
    const Outcome run = neontetra(mistake.arguments);
    EXPECT_EQ(run.exit_code, mistake.exit_code) << mistake.arguments;
    EXPECT_NE(run.err.find(mistake.words), std::string::npos) << mistake.arguments << "\n" << run.err;
  }
}

}  // namespace
}  // namespace nt
