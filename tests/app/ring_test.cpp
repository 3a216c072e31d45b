// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/ring.h"

#include <gtest/gtest.h>

#include <thread>

namespace nt {
namespace {

using std::chrono::milliseconds;

TEST(Ring, GivesBackWhatWasPutInInOrder) {
  Ring<int> ring(3);
  EXPECT_EQ(ring.oldest(), nullptr);
  for (int i = 0; i < 3; ++i) {
    ASSERT_NE(ring.free_slot(), nullptr);
    *ring.free_slot() = i;
    ring.push();
  }
  EXPECT_EQ(ring.free_slot(), nullptr);
  for (int i = 0; i < 3; ++i) {
    ASSERT_NE(ring.oldest(), nullptr);
    EXPECT_EQ(*ring.oldest(), i);
    ring.pop();
  }
  EXPECT_EQ(ring.oldest(), nullptr);
  EXPECT_EQ(ring.size(), 0u);
}

TEST(Ring, ASlotThatIsLookedAtIsNotWrittenTo) {
  Ring<int> ring(1);
  *ring.free_slot() = 7;
  ring.push();
  const int* seen = ring.oldest();
  EXPECT_EQ(ring.free_slot(), nullptr);
  EXPECT_EQ(*seen, 7);
}

TEST(Ring, WhatWasPushedLastCanBeTakenBackUnlessItIsLookedAt) {
  Ring<int> ring(2);
  *ring.free_slot() = 1;
  ring.push();
  EXPECT_FALSE(ring.take_back());
  *ring.free_slot() = 2;
  ring.push();
  EXPECT_EQ(*ring.oldest(), 1);
  ASSERT_TRUE(ring.take_back());
  *ring.free_slot() = 3;
  ring.push();
  EXPECT_EQ(*ring.oldest(), 1);
  ring.pop();
  EXPECT_EQ(*ring.oldest(), 3);
}

TEST(Ring, BetweenTwoThreadsNothingIsLostAndNothingChangesPlaces) {
  constexpr int kCount = 20'000;
  Ring<int> ring(4);
  std::thread writer([&] {
    for (int i = 0; i < kCount; ++i) {
      while (!ring.wait_free(milliseconds(100))) {
      }
      *ring.free_slot() = i;
      ring.push();
    }
    ring.close();
  });
  int next = 0;
  for (bool last = false; !last;) {
    last = ring.closed();
    ring.wait_filled(milliseconds(100));
    while (const int* value = ring.oldest()) {
      ASSERT_EQ(*value, next++);
      ring.pop();
    }
  }
  writer.join();
  EXPECT_EQ(next, kCount);
}

TEST(Ring, ClosingItWakesWhoeverWaits) {
  Ring<int> ring(1);
  std::thread closer([&] { ring.close(); });
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(ring.wait_filled(std::chrono::seconds(30)));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  closer.join();
}

}  // namespace
}  // namespace nt
