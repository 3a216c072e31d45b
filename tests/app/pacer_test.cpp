// SPDX-License-Identifier: Apache-2.0
#include "app/pacer.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

constexpr int64_t kPeriod = 40;

TEST(Pacer, FramesOnTimeAreAllShown) {
  Pacer pacer(kPeriod);
  pacer.start(1000);
  for (int64_t n = 0; n < 50; ++n) {
    EXPECT_FALSE(pacer.due(1000 + n * kPeriod - 1));
    EXPECT_TRUE(pacer.due(1000 + n * kPeriod));
    EXPECT_EQ(pacer.take(1000 + n * kPeriod + 5), 0);  // a little late each time: that does not add up
  }
}

TEST(Pacer, LateFramesAreSkippedAndTheClipKeepsItsSpeed) {
  Pacer pacer(kPeriod);
  pacer.start(0);
  EXPECT_EQ(pacer.take(3 * kPeriod + 7), 3);
  EXPECT_FALSE(pacer.due(4 * kPeriod - 1));
  EXPECT_TRUE(pacer.due(4 * kPeriod));
}

TEST(Pacer, ADriverKeepsAFewFrames) {
  Pacer pacer(kPeriod, 3);
  pacer.start(0);
  EXPECT_EQ(pacer.take(4 * kPeriod - 1), 0) << "three wait behind it";
  EXPECT_TRUE(pacer.due(4 * kPeriod - 1)) << "and follow at once";
  EXPECT_EQ(pacer.take(4 * kPeriod), 0);
  EXPECT_EQ(pacer.skips(6 * kPeriod), 4);
  EXPECT_EQ(pacer.take(6 * kPeriod), 4) << "the ring has run over";
  EXPECT_FALSE(pacer.due(7 * kPeriod - 1));
}

TEST(Pacer, ASourceThatIsTooSlowIsNotChased) {
  Pacer pacer(kPeriod);
  pacer.start(0);
  int64_t now = 0;
  for (int round = 0; round < 20; ++round) {  // every frame, skipped or not, takes twice its period
    const int skips = pacer.take(now);
    ASSERT_LE(skips, Pacer::kMostSkips);
    now += (skips + 1) * 2 * kPeriod;
  }
  pacer.take(1'000'000);
  EXPECT_FALSE(pacer.due(1'000'000 + kPeriod - 1));
  EXPECT_TRUE(pacer.due(1'000'000 + kPeriod));
}

}  // namespace
}  // namespace nt
