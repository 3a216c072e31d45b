// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/settling.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

constexpr int64_t kFrame_ns = 33'000'000;

// Frames until the brightness of frame n has settled.
template <class Brightness>
int frames_until(Brightness brightness) {
  Settling settling;
  int n = 0;
  while (!settling.settled(brightness(n), n * kFrame_ns)) ++n;
  return n;
}

TEST(Settling, WaitsUntilTheBrightnessRests) {
  EXPECT_EQ(frames_until([](int) { return 100.0; }), 9);
  EXPECT_EQ(frames_until([](int n) { return n < 20 ? 50.0 + 3 * n : 110.0; }), 29);
}

TEST(Settling, ButNoLongerThanThreeSeconds) {
  EXPECT_EQ(frames_until([](int n) { return n % 2 == 0 ? 50.0 : 90.0; }), 91);
}

TEST(Settling, LetsAFewFramesGoAfterTheLock) {
  Settling settling;
  for (int n = 0; n < 10; ++n) settling.settled(100, n * kFrame_ns);
  settling.set_locked();
  EXPECT_FALSE(settling.settled(100, 0));
  EXPECT_FALSE(settling.settled(100, 0));
  EXPECT_TRUE(settling.settled(100, 0));
}

}  // namespace
}  // namespace nt
