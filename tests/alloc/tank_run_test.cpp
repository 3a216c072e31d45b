// SPDX-License-Identifier: Apache-2.0
// After frame 0 core allocates nothing: malloc and its kin are interposed and counted around every step.
#include <gtest/gtest.h>

#include <memory>

#include "platform/linux/heap_count.h"
#include "tests/support/tank_run.h"

namespace {

int64_t allocations_after_frame_0(const nt::TankSettings& settings, int frames, int& poses,
                                  const nt::CaptureSettings& capture = {}) {
  nt::test::TankRun run(settings, nt::test::limits_for(settings), capture);
  run.film();
  run.step();
  int64_t sum = 0;
  for (int n = 1; n < frames; ++n) {
    run.film();
    const nt::HeapCount heap;
    run.step();
    sum += heap.allocations();
  }
  poses = run.poses();
  return sum;
}

}  // namespace

TEST(Alloc, TheCounterSeesAnAllocation) {
  ASSERT_TRUE(nt::heap_count_available());
  const nt::HeapCount heap;
  const auto number = std::make_unique<volatile int>(1);
  EXPECT_EQ(*number, 1);
  EXPECT_EQ(heap.allocations(), 1);
}

TEST(Alloc, NoneInTenThousandFrames) {
  int poses = 0;
  EXPECT_EQ(allocations_after_frame_0({.width = 320, .height = 180}, 10000, poses), 0);
  EXPECT_GT(poses, 5000) << "most frames must have gone through every stage";
}

TEST(Alloc, NoneWithACameraInTheHand) {
  int poses = 0;
  nt::CaptureSettings capture;
  capture.stabilise = nt::Stabilise::on;
  EXPECT_EQ(allocations_after_frame_0({.scene = "shake", .width = 320, .height = 180}, 1500, poses, capture), 0);
  EXPECT_GT(poses, 700);
}

TEST(Alloc, NoneAtTheDefaultSize) {
  int poses = 0;
  EXPECT_EQ(allocations_after_frame_0({}, 10000, poses), 0);
  EXPECT_GT(poses, 250);
}

TEST(Alloc, NoneWithSeveralFish) {
  int poses = 0;
  nt::CaptureSettings eight;
  eight.max_fish = 8;
  EXPECT_EQ(allocations_after_frame_0({.scene = "crossing", .width = 480, .height = 272}, 1500, poses, eight), 0);
  EXPECT_GT(poses, 800);
}

TEST(Alloc, NoneWhereALampGoesOnOrTheFirstFrameHoldsAFish) {
  for (const char* scene : {"lamp", "station"}) {
    int poses = 0;
    EXPECT_EQ(allocations_after_frame_0({.scene = scene, .width = 320, .height = 180}, 300, poses), 0) << scene;
    EXPECT_GT(poses, 150) << scene;
  }
}
