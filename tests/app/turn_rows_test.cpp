// SPDX-License-Identifier: Apache-2.0
#include "app/export/turn_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "app/export/pose_csv.h"
#include "platform/camera.h"
#include "tests/app/csv_table.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

// A straight fish along x: head at 0, tail at 100, centre at 40.
FishPose straight(bool turned, float confidence = 0.9f) {
  FishPose pose;
  pose.status = PoseStatus::ok;
  pose.head = {turned ? 100.0f : 0.0f, 5}, pose.tail = {turned ? 0.0f : 100.0f, 5};
  pose.centre = {40, 5};
  pose.dir = {turned ? 1.0f : -1.0f, 0};
  for (int i = 0; i < pose.u_num; ++i)
    pose.up_axis[i] = lerp(pose.centre, pose.head, static_cast<float>(i + 1) / static_cast<float>(pose.u_num + 1));
  for (int i = 0; i < pose.l_num; ++i)
    pose.low_axis[i] = lerp(pose.centre, pose.tail, static_cast<float>(i + 1) / static_cast<float>(pose.l_num + 1));
  pose.l_fin = {30, 15}, pose.jun_tl = {25, 9}, pose.jun_bl = {35, 9};
  pose.confidence = {1, confidence, confidence, 0.7f, 0, 1};
  return pose;
}

// Ten rows, of which 3 to 5 are recorded the wrong way round; one row in between has no pose.
std::string write_ten(const std::string& path, bool repair) {
  PoseCsv csv(path, 1.0f);
  for (int i = 0; i < 10; ++i) {
    const bool wrong = i >= 3 && i <= 5;
    FishPose pose = straight(wrong, wrong ? 0.6f : 0.9f);
    if (i == 4) pose.status = PoseStatus::lost;
    csv.add(i, i * 40'000'000, pose, {wrong ? -1.0f : 1.0f, i == 3 || i == 6 ? -6.0f : 6.0f});
  }
  csv.close();
  if (repair) {
    EXPECT_EQ(csv.look_back(), 2);
  }
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(TurnRows, HeadAndTailAreRightOverTheWholeRecording) {
  const TempDir dir;
  write_ten(dir / "p.csv", true);
  const CsvTable table(dir / "p.csv");
  ASSERT_EQ(table.rows(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    if (i == 4) continue;
    EXPECT_DOUBLE_EQ(*table.number(i, "head_x"), 0) << i;
    EXPECT_DOUBLE_EQ(*table.number(i, "tail_x"), 100) << i;
    EXPECT_DOUBLE_EQ(*table.number(i, "centre_x"), 40) << i;
    EXPECT_NEAR(*table.number(i, "up_axis_1_x"), 30, 1e-3) << i;
    EXPECT_NEAR(*table.number(i, "up_axis_3_x"), 10, 1e-3) << i;
    EXPECT_NEAR(*table.number(i, "low_axis_1_x"), 43.75, 2e-3) << i;
    EXPECT_NEAR(*table.number(i, "low_axis_15_x"), 96.25, 2e-3) << i;
    EXPECT_NEAR(*table.number(i, "dir_rad"), *table.number(0, "dir_rad"), 1e-4) << "one direction throughout";
    EXPECT_EQ(table.number(i, "l_fin_x").has_value(), i != 3 && i != 5) << "a turned row has no fins";
  }
  EXPECT_NEAR(*table.number(3, "head_confidence"), 0.4, 1e-9);
  EXPECT_NEAR(*table.number(3, "l_fin_confidence"), 0, 1e-9);
  EXPECT_EQ(table.text(4, "status"), "lost");
  EXPECT_FALSE(std::filesystem::exists(dir / "p.csv.turning"));
}

TEST(TurnRows, TwiceTurnedIsAsBeforeButForTheFins) {
  const TempDir dir;
  write_ten(dir / "p.csv", false);
  std::ifstream in(dir / "p.csv");
  std::string row;
  std::getline(in, row), std::getline(in, row);
  const std::string twice = turned_row(turned_row(row, 3, 15), 3, 15);
  // dir_rad goes on by half a turn each time; the rest is as it was.
  const auto up_to = [](const std::string& r, int cells) {
    std::size_t at = 0;
    while (cells-- > 0) at = r.find(',', at) + 1;
    return at;
  };
  EXPECT_EQ(twice.substr(0, up_to(twice, 5)), row.substr(0, up_to(row, 5)));
  EXPECT_EQ(twice.substr(up_to(twice, 6), up_to(twice, 10) - up_to(twice, 6)),
            row.substr(up_to(row, 6), up_to(row, 10) - up_to(row, 6)));
  EXPECT_EQ(twice.substr(up_to(twice, 22), up_to(twice, 61) - up_to(twice, 22)),
            row.substr(up_to(row, 22), up_to(row, 61) - up_to(row, 22)));
  EXPECT_NE(turned_row(row, 3, 15), row);
}

TEST(TurnRows, NothingToTurnLeavesTheFileAlone) {
  const TempDir dir;
  const std::string before = write_ten(dir / "p.csv", false);
  EXPECT_EQ(turn_rows(dir / "p.csv", std::vector<uint8_t>(9, 0), 3, 15), 0);
  std::ifstream in(dir / "p.csv");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), before);
  EXPECT_EQ(turn_rows("-", std::vector<uint8_t>(9, 1), 3, 15), 0);
  EXPECT_EQ(turn_rows("/dev/null", std::vector<uint8_t>(9, 1), 3, 15), 0);
}

TEST(TurnRows, WhatCannotBeWrittenIsKeptAsRecorded) {
  const TempDir dir;
  const std::string before = write_ten(dir / "p.csv", false);
  std::filesystem::create_directory(dir / "p.csv.turning");  // where the new file should go
  EXPECT_THROW(turn_rows(dir / "p.csv", std::vector<uint8_t>(9, 1), 3, 15), UserError);
  std::ifstream in(dir / "p.csv");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), before);
}

TEST(TurnRows, RowsThatAreNotAsWrittenAreKept) {
  for (const char* row : {"", ",,,", "1,2,ok", "0,0,ok,x,y,z"}) EXPECT_EQ(turned_row(row, 3, 15), row);
  const TempDir dir;
  { std::ofstream(dir / "p.csv") << "frame,t_s,status\n0,0.0,ok\n\n1,0.0,ok,1,2,nonsense\n"; }
  EXPECT_EQ(turn_rows(dir / "p.csv", std::vector<uint8_t>(2, 1), 3, 15), 2);
  std::ifstream in(dir / "p.csv");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}),
            "frame,t_s,status\n0,0.0,ok\n\n1,0.0,ok,1,2,nonsense\n");
}

}  // namespace
}  // namespace nt
