// SPDX-License-Identifier: Apache-2.0
// Counts this thread's heap allocations between two points, to show that core makes none after frame 0.
//
// malloc, calloc, realloc and the aligned ones are interposed over glibc's own for the whole program; the counter is
// thread-local and runs only inside a HeapCount's lifetime, so other threads (a video encoder) are not charged.
// Not available under sanitizers (they own malloc) or without glibc: heap_count_available() is false there.
#pragma once
#include <cstdint>

namespace nt {

bool heap_count_available();

// Counts from construction; one at a time on a thread.
class HeapCount {
 public:
  HeapCount();
  ~HeapCount();
  HeapCount(const HeapCount&) = delete;
  HeapCount& operator=(const HeapCount&) = delete;
  int64_t allocations() const;
};

}  // namespace nt
