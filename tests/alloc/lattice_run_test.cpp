// SPDX-License-Identifier: Apache-2.0
// The lattice solver allocates nothing, markers coming and going included.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "platform/linux/heap_count.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

TEST(LatticeAlloc, AThousandFramesAllocateNothing) {
  const LatticeData data = bar(8, 3, 2, 4);
  Solver solver(data);
  auto markers = rest_markers(solver.view());
  std::vector<uint8_t> seen(markers.size(), 1);
  Random random(2);
  solver->step(markers, seen);
  ASSERT_TRUE(heap_count_available());
  const HeapCount heap;
  for (int f = 0; f < 1000; ++f) {
    for (Vec3& m : markers) m += Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f} * 0.05f;
    for (uint8_t& s : seen) s = random.below(10) != 0;
    solver->step(markers, seen);
  }
  EXPECT_EQ(heap.allocations(), 0);
}

}  // namespace
}  // namespace nt::test
