// SPDX-License-Identifier: Apache-2.0
// Frames of a take that were not recorded come back without a pose, so that all its fish are equally long.
#include <gtest/gtest.h>

#include "tests/app/run_binary.h"
#include "tests/app/take_frames.h"

namespace nt {
namespace {

TEST(TakeGaps, MissingFramesHaveNoPose) {
  const TempDir dir;
  Take take = Take::create(dir / "a.take", test_take_info());
  std::vector<TakeFrame> frames;
  for (const int i : {5, 6, 9, 12, 13}) frames.push_back(test_take_frame(i));
  for (const int i : {8, 11}) frames.push_back(test_take_frame(i, 2));
  take.append(frames);
  const std::vector<TakeFrame> one = take.frames(0), other = take.frames(2);
  ASSERT_EQ(one.size(), 9u);
  ASSERT_EQ(other.size(), 9u);
  for (int i = 0; i < 9; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(one[at].frame, i + 5);
    EXPECT_EQ(other[at].frame, i + 5);
    EXPECT_EQ(other[at].fish, 2);
    const bool there = i == 0 || i == 1 || i == 4 || i == 7 || i == 8;
    EXPECT_EQ(one[at].pose.status, there ? test_take_frame(i + 5).pose.status : PoseStatus::lost) << i;
    EXPECT_EQ(other[at].pose.status,
              i == 3 || i == 6 ? test_take_frame(i + 5).pose.status : (i < 3 ? PoseStatus::absent : PoseStatus::lost))
        << i;
  }
  EXPECT_EQ(one[2].motion.centre.x, one[1].motion.centre.x);
  EXPECT_EQ(one[2].pose.confidence.head, 0);
  EXPECT_NEAR(static_cast<double>(one[3].motion.time_ns), static_cast<double>(test_take_frame(8).motion.time_ns), 1e6);
  EXPECT_TRUE(take.frames(1).empty());
}

TEST(TakeGaps, AGapBeyondReasonIsDamage) {
  const TempDir dir;
  Take take = Take::create(dir / "a.take", test_take_info());
  take.append(std::vector<TakeFrame>{test_take_frame(0), test_take_frame(1'000'000'000'000)});
  EXPECT_ANY_THROW(take.frames(0));
}

}  // namespace
}  // namespace nt
