// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/frame_clock.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

constexpr int64_t kMs = 1'000'000;

TEST(FrameClock, StartsAtZeroAndKeepsTheDriversGaps) {
  FrameClock clock;
  EXPECT_EQ(clock.take(7, 1000 * kMs, 1001 * kMs).sequence, 0u);
  EXPECT_EQ(clock.take(8, 1033 * kMs, 1034 * kMs).sequence, 1u);
  const FrameClock::Stamp stamp = clock.take(12, 1166 * kMs, 1170 * kMs);
  EXPECT_EQ(stamp.sequence, 5u);
  EXPECT_EQ(stamp.timestamp_ns, 166 * kMs);
  EXPECT_EQ(clock.epoch_ns(), 1000 * kMs);
  EXPECT_EQ(clock.odd_times(), 0);
}

TEST(FrameClock, ACountThatStandsStillWrapsOrLeapsIsOneMore) {
  FrameClock clock;
  clock.take(0xffffffffu, 1000 * kMs, 1000 * kMs);
  EXPECT_EQ(clock.take(0, 1033 * kMs, 1033 * kMs).sequence, 1u);  // wrapped
  EXPECT_EQ(clock.take(0, 1066 * kMs, 1066 * kMs).sequence, 2u);
  EXPECT_EQ(clock.take(0x70000000u, 1100 * kMs, 1100 * kMs).sequence, 3u);
  EXPECT_EQ(clock.take(5, 1133 * kMs, 1133 * kMs).sequence, 4u);
}

TEST(FrameClock, ATimeThatMakesNoSenseIsReplaced) {
  FrameClock clock;
  clock.take(0, 100'000 * kMs, 100'000 * kMs);
  EXPECT_EQ(clock.take(1, 5 * kMs, 100'033 * kMs).timestamp_ns, 33 * kMs);
  EXPECT_EQ(clock.take(2, 900'000 * kMs, 100'066 * kMs).timestamp_ns, 66 * kMs);
  EXPECT_EQ(clock.take(3, 100'060 * kMs, 100'066 * kMs).timestamp_ns, 66 * kMs + 1);
  EXPECT_EQ(clock.odd_times(), 3);
}

TEST(FrameClock, AfterARestartTheTimeTellsWhatWasMissed) {
  FrameClock clock;
  clock.take(0, 0, 0);
  clock.take(1, 33 * kMs, 33 * kMs);
  clock.restart(30);
  EXPECT_EQ(clock.take(0, 1033 * kMs, 1033 * kMs).sequence, 1u + 30);
  EXPECT_EQ(clock.take(1, 1066 * kMs, 1066 * kMs).sequence, 2u + 30);
}

TEST(FrameClock, ACameraThatFilmsMoreSlowlyThanItSaysMissesFewer) {
  FrameClock clock;
  for (uint32_t i = 0; i <= 10; ++i) clock.take(i, i * 200 * kMs, i * 200 * kMs);
  clock.restart(30);
  EXPECT_EQ(clock.take(0, 4000 * kMs, 4000 * kMs).sequence, 20u);
}

TEST(FrameClock, APictureThatWasOvertakenIsLate) {
  FrameClock clock;
  EXPECT_FALSE(clock.is_late(7)) << "there is nothing to be behind";
  clock.take(2, 66 * kMs, 66 * kMs);
  EXPECT_TRUE(clock.is_late(0));
  EXPECT_FALSE(clock.is_late(3));
  clock.take(0x100, 99 * kMs, 99 * kMs);
  EXPECT_FALSE(clock.is_late(3)) << "a driver that counts anew";
  clock.restart(30);
  EXPECT_FALSE(clock.is_late(0xff));
}

}  // namespace
}  // namespace nt
