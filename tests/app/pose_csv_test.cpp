// SPDX-License-Identifier: Apache-2.0
#include "app/export/pose_csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/csv_table.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

FishPose pose_at(float angle) {
  FishPose pose;
  pose.status = PoseStatus::ok;
  pose.centre = {10, 20};
  pose.dir = {std::cos(angle), std::sin(angle)};
  pose.head = {30, 20};
  pose.tail = {1, 20};
  pose.l_fin = {12, 15};
  pose.jun_tl = {13, 17};
  pose.confidence = {1, 0.9f, 0.8f, 0.7f, 0, 1};
  return pose;
}

TEST(PoseCsv, HeaderIsTheIssues) {
  const std::string header = pose_csv_header(3, 15);
  EXPECT_TRUE(
      header.starts_with("frame,t_s,status,centre_x,centre_y,dir_rad,head_x,head_y,tail_x,tail_y,"
                         "l_fin_x,l_fin_y,r_fin_x,r_fin_y,jun_tl_x,jun_tl_y,jun_tr_x,jun_tr_y,"
                         "jun_bl_x,jun_bl_y,jun_br_x,jun_br_y,up_axis_1_x,up_axis_1_y,"));
  EXPECT_TRUE(
      header.ends_with(",low_axis_15_x,low_axis_15_y,centre_confidence,head_confidence,tail_confidence,"
                       "l_fin_confidence,r_fin_confidence,axis_confidence\n"));
}

TEST(PoseCsv, PointsAreInSourcePixelsAndEmptyWhereNotSeen) {
  const TempDir dir;
  PoseCsv csv(dir / "p.csv", 2.0f);
  csv.add(0, 0, pose_at(0));
  FishPose lost;
  lost.status = PoseStatus::lost;
  lost.centre = {5, 5};
  csv.add(1, 40'000'000, lost);
  csv.close();
  const CsvTable table(dir / "p.csv");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.cells(0), table.columns());
  EXPECT_EQ(table.cells(1), table.columns());
  // Pixel 10 of a half-size frame covers pixels 20 and 21 of the source.
  EXPECT_DOUBLE_EQ(*table.number(0, "centre_x"), 20.5);
  EXPECT_DOUBLE_EQ(*table.number(0, "head_y"), 40.5);
  EXPECT_TRUE(table.number(0, "l_fin_x").has_value());
  EXPECT_TRUE(table.number(0, "jun_tl_x").has_value());
  EXPECT_FALSE(table.number(0, "r_fin_x").has_value());
  EXPECT_FALSE(table.number(0, "jun_tr_x").has_value());
  EXPECT_DOUBLE_EQ(*table.number(0, "head_confidence"), 0.9);
  EXPECT_EQ(table.text(1, "status"), "lost");
  EXPECT_DOUBLE_EQ(*table.number(1, "t_s"), 0.04);
  for (const char* column : {"centre_x", "dir_rad", "head_x", "low_axis_15_y"}) {
    EXPECT_FALSE(table.number(1, column).has_value()) << column;
  }
}

TEST(PoseCsv, DirectionIsContinuous) {
  const TempDir dir;
  PoseCsv csv(dir / "p.csv", 1.0f);
  for (int i = 0; i < 100; ++i) csv.add(i, 0, pose_at(0.2f * static_cast<float>(i)));
  csv.close();
  const CsvTable table(dir / "p.csv");
  EXPECT_NEAR(*table.number(99, "dir_rad"), 0.2 * 99, 1e-3);
}

TEST(ToSource, TurnsBack) {
  const Vec2 p = to_working(to_source({123.25f, 7.5f}, 1.7f), 1.7f);
  EXPECT_NEAR(p.x, 123.25f, 1e-4f);
  EXPECT_NEAR(p.y, 7.5f, 1e-4f);
}

}  // namespace
}  // namespace nt
