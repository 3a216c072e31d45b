// SPDX-License-Identifier: Apache-2.0
#include "app/statistics.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

TEST(TimeHistogram, QuantilesAreWithinThreePercent) {
  TimeHistogram times;
  EXPECT_EQ(times.quantile_ns(0.5), 0);
  for (int i = 1; i <= 1000; ++i) times.add(i * 1000);
  EXPECT_NEAR(times.quantile_ns(0.5), 500e3, 15e3);
  EXPECT_NEAR(times.quantile_ns(0.99), 990e3, 30e3);
  EXPECT_NEAR(times.quantile_ns(0.999), 999e3, 30e3);
  times.add(-5);
  times.add(INT64_MAX);
  EXPECT_EQ(times.count(), 1002);
}

TEST(Statistics, CountsStatusesFlagsAndBlobs) {
  Statistics statistics;
  StepReport report;
  report.status = PoseStatus::ok;
  report.flags = kRelearned | kRunsDropped;
  report.blobs = 4;
  statistics.add(report);
  report.status = PoseStatus::lost;
  report.flags = 0;
  report.blobs = 2;
  statistics.add(report);
  EXPECT_EQ(statistics.frames, 2);
  EXPECT_EQ(statistics.poses, 1);
  EXPECT_EQ(statistics.by_status[static_cast<std::size_t>(PoseStatus::lost)], 1);
  EXPECT_EQ(statistics.by_flag[0], 1);
  EXPECT_EQ(statistics.by_flag[4], 1);
  EXPECT_STREQ(kFlagNames[4], "relearned");
  EXPECT_EQ(statistics.most_blobs, 4);
}

}  // namespace
}  // namespace nt
