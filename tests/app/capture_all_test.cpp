// SPDX-License-Identifier: Apache-2.0
// capture --all: every fish of the tank has a table of its own, and keeps it where they swim over each other.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/export/fish_files.h"
#include "platform/camera.h"
#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

// Which of the true fish each row of a table is nearest to: rows by fish.
std::map<int, int> nearest_fish(const CsvTable& table, const std::vector<std::unique_ptr<CsvTable>>& truths) {
  std::map<int, int> rows_of;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "status") != "ok") continue;
    const double frame = *table.number(row, "frame");
    int nearest = -1;
    double least = 1e9;
    for (std::size_t i = 0; i < truths.size(); ++i) {
      const double at = frame - *truths[i]->number(0, "frame");  // a table starts with its fish
      if (at < 0 || !truths[i]->number(static_cast<std::size_t>(at), "centre_x")) continue;
      const auto true_row = static_cast<std::size_t>(at);
      const double off = std::hypot(*table.number(row, "centre_x") - *truths[i]->number(true_row, "centre_x"),
                                    *table.number(row, "centre_y") - *truths[i]->number(true_row, "centre_y"));
      if (off < least) least = off, nearest = static_cast<int>(i);
    }
    ++rows_of[nearest];
  }
  return rows_of;
}

TEST(CaptureAll, EachFishHasItsTableAndKeepsIt) {
  const TempDir dir;
  const Outcome run =
      neontetra("capture -c sim:scene=crossing,seed=1,frames=600 --background vibe --all --csv " + dir / "fish.csv" +
                " --truth " + dir / "truth.csv" + " --json " + dir / "report.json" + " --overlay " + dir / "all.mp4");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("fish-1.csv"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(dir / "fish.csv"));
  EXPECT_FALSE(std::filesystem::exists(dir / "fish-4.csv")) << "three fish";
  std::vector<std::unique_ptr<CsvTable>> truths;
  for (int i = 1; i <= 3; ++i) truths.push_back(std::make_unique<CsvTable>(fish_file(dir / "truth.csv", i)));
  std::map<int, int> tables_of;
  const nlohmann::json report = nlohmann::json::parse(read_text(dir / "report.json"));
  ASSERT_EQ(report["fish"].size(), 3u);
  for (int i = 1; i <= 3; ++i) {
    const CsvTable table(fish_file(dir / "fish.csv", i));
    ASSERT_GT(table.rows(), 300u) << i;
    EXPECT_EQ(*table.number(table.rows() - 1, "frame"), 599) << "a row for every frame once it is there";
    const std::map<int, int> rows_of = nearest_fish(table, truths);
    int all = 0, most = 0, fish = -1;
    for (const auto& [who, rows] : rows_of) {
      all += rows;
      if (rows > most) most = rows, fish = who;
    }
    EXPECT_GT(all, 250) << i;
    EXPECT_GE(most, 0.99 * all) << "table " << i << " is of more than one fish";
    ++tables_of[fish];
    EXPECT_EQ(report["fish"][static_cast<std::size_t>(i - 1)]["number"], i);
    EXPECT_EQ(report["fish"][static_cast<std::size_t>(i - 1)]["frames_with_pose"], all);
  }
  EXPECT_EQ(tables_of.size(), 3u) << "two tables are of one fish";
}

TEST(CaptureAll, FilesAreNumberedBeforeTheirEnding) {
  EXPECT_EQ(fish_file("fish.csv", 2), "fish-2.csv");
  EXPECT_EQ(fish_file("out/my.fish.csv", 11), "out/my.fish-11.csv");
  EXPECT_EQ(fish_file("out/x", 1), "out/x-1");
}

TEST(CaptureAll, AFileStartsWithItsFish) {
  const TempDir dir;
  FishFiles files("--csv", dir / "f.csv", 1.0f, 3);
  FishPose none, seen;
  seen.status = PoseStatus::ok;
  for (int n = 0; n < 5; ++n) {
    files.add(0, n, n, none);
    files.add(2, n, n, n == 2 ? seen : none);
  }
  files.close();
  EXPECT_FALSE(std::filesystem::exists(dir / "f-1.csv"));
  const CsvTable table(dir / "f-3.csv");
  ASSERT_EQ(table.rows(), 3u);
  EXPECT_EQ(*table.number(0, "frame"), 2);
  EXPECT_EQ(table.text(1, "status"), "absent");
  EXPECT_EQ(files.written(), dir / "f-3.csv");
}

TEST(CaptureAll, WhatCannotBeIsOneLine) {
  const TempDir dir;
  const auto one_line = [](const std::string& arguments, const std::string& holds) {
    const Outcome run = neontetra("capture -c sim:frames=2,size=320x240 --background vibe " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(run.error_lines(), 1) << run.err;
    EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
  };
  one_line("--all --csv -", "fish-1.csv");
  one_line("--max-fish 3", "--all");
  one_line("--all --max-fish 0", "--max-fish");
  one_line("--all --max-fish 17", "--max-fish");
  one_line("--all --csv " + dir / "a.csv" + " --overlay " + dir / "a-2.csv", "a-2.csv");
}

}  // namespace
}  // namespace nt
