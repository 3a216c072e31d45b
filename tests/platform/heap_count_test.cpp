// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/heap_count.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>
#include <vector>

namespace nt {
namespace {

// The compiler may leave out an allocation that nobody looks at.
void* volatile seen = nullptr;

TEST(HeapCount, CountsEveryKindOfAllocation) {
  if (!heap_count_available()) GTEST_SKIP() << "the sanitizer owns malloc";
  const HeapCount heap;
  seen = std::malloc(10);
  seen = std::realloc(seen, 1000);
  std::free(seen);
  seen = std::calloc(3, 7);
  std::free(seen);
  seen = std::aligned_alloc(64, 128);
  std::free(seen);
  const std::vector<int> numbers(100);
  seen = const_cast<int*>(numbers.data());
  EXPECT_EQ(heap.allocations(), 5);
}

TEST(HeapCount, LeavesOtherThreadsAndOtherTimesOut) {
  if (!heap_count_available()) GTEST_SKIP() << "the sanitizer owns malloc";
  seen = std::malloc(10);
  std::free(seen);
  const HeapCount heap;
  EXPECT_EQ(heap.allocations(), 0);
  std::thread other([] {
    for (int i = 0; i < 100; ++i) {
      void* volatile block = std::malloc(10);
      std::free(block);
    }
  });
  other.join();
  EXPECT_LT(heap.allocations(), 10);  // starting the thread costs this one a few
}

}  // namespace
}  // namespace nt
