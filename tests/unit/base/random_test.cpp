// SPDX-License-Identifier: Apache-2.0
#include "core/base/random.h"

#include <gtest/gtest.h>

#include <set>

namespace nt {
namespace {

// The three shifts and the multiplier of xorshift64* (Vigna 2016), written out once more, after the seeding.
TEST(Random, IsXorshift64Star) {
  uint64_t state = 7 * 0x9e3779b97f4a7c15ull + 0x2545f4914f6cdd1dull;
  const auto next = [&state] {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * 2685821657736338717ull;  // the paper's M_32
  };
  for (int i = 0; i < 4; ++i) next();
  Random random(7);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(random.next(), next()) << i;
}

TEST(Random, NeighbouringSeedsPartCompany) {
  std::set<uint64_t> firsts;
  for (uint64_t seed = 0; seed < 1000; ++seed) firsts.insert(Random(seed).next() >> 32);
  EXPECT_GT(firsts.size(), 995u);
}

TEST(Random, BelowIsEvenAndStaysBelow) {
  Random random(3);
  int counts[10] = {};
  for (int i = 0; i < 100'000; ++i) {
    const uint32_t v = random.below(10);
    ASSERT_LT(v, 10u);
    ++counts[v];
  }
  for (int count : counts) EXPECT_NEAR(count, 10'000, 500);  // 5 standard deviations
  for (int i = 0; i < 100; ++i) EXPECT_EQ(random.below(1), 0u);
  for (int i = 0; i < 100; ++i) EXPECT_LT(random.below(0xffffffffu), 0xffffffffu);
}

TEST(Random, UnitIsEvenAndNeverOne) {
  Random random(5);
  double sum = 0, least = 1, most = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double v = random.unit();
    sum += v;
    least = v < least ? v : least;
    most = v > most ? v : most;
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(most, 1);
  EXPECT_LT(least, 0.001);
  EXPECT_GT(most, 0.999);
  EXPECT_NEAR(sum / 100'000, 0.5, 0.005);
}

}  // namespace
}  // namespace nt
