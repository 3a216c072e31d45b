// SPDX-License-Identifier: Apache-2.0
#include "core/deform/elimination_order.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

// A graph and what its elimination in some order fills in.
class Graph {
 public:
  explicit Graph(std::size_t n) : n_(n), block_(n * n / 8 + 64 * n), arena_(block_.span()), table_(arena_, n) {}
  void join(std::size_t a, std::size_t b) { table_.set(a, b), table_.set(b, a); }
  std::vector<uint16_t> order() const {
    Block scratch(n_ * n_ + 64 * n_ + 4096);
    Arena arena(scratch.span());
    std::vector<uint16_t> place(n_);
    EXPECT_TRUE(smallest_factor_order(arena, table_, place));
    return place;
  }
  std::size_t entries(const std::vector<uint16_t>& place) const {
    Graph left(n_);
    left.table_.copy(table_);
    std::size_t sum = 0;
    for (const uint16_t v : place) {
      sum += left.table_.count(v);
      eliminate(left.table_, v);
    }
    return sum;
  }
  const BitTable& table() const { return table_; }

 private:
  std::size_t n_;
  Block block_;
  Arena arena_;
  BitTable table_;
};

TEST(EliminationOrderTest, ATreeIsNotFilledIn) {
  Graph tree(200);
  Random random(5);
  for (std::size_t v = 1; v < 200; ++v) {
    tree.join(v, static_cast<std::size_t>(random.unit() * static_cast<float>(v)));
  }
  const auto place = tree.order();
  EXPECT_EQ(std::set<uint16_t>(place.begin(), place.end()).size(), 200u);
  EXPECT_EQ(tree.entries(place), 199u);
}

// A wheel: a vertex of the rim has three neighbours whenever its turn comes, the hub at first all.
TEST(EliminationOrderTest, AHubComesLast) {
  Graph wheel(41);
  for (std::size_t v = 1; v < 41; ++v) wheel.join(0, v), wheel.join(v, v % 40 + 1);
  const auto place = wheel.order();
  std::vector<uint16_t> by_number(41);
  for (std::size_t v = 0; v < 41; ++v) by_number[v] = static_cast<uint16_t>(v);
  EXPECT_EQ(wheel.entries(by_number), 40u * 41u / 2u);
  EXPECT_EQ(wheel.entries(place), 38u * 3u + 2u + 1u);
}

// Of a square grid; row by row it takes 13,000, and by fewest neighbours alone 5,539.
TEST(EliminationOrderTest, AGridIsFilledInLittle) {
  constexpr std::size_t kSide = 24;
  Graph grid(kSide * kSide);
  for (std::size_t v = 0; v < kSide * kSide; ++v) {
    if (v % kSide != 0) grid.join(v, v - 1);
    if (v >= kSide) grid.join(v, v - kSide);
  }
  EXPECT_LE(grid.entries(grid.order()), 5156u);
}

TEST(EliminationOrderTest, TooLittleScratchIsTold) {
  Graph pair(70);
  Block block(256);
  Arena arena(block.span());
  std::vector<uint16_t> place(70);
  EXPECT_FALSE(smallest_factor_order(arena, pair.table(), place));
}

}  // namespace
}  // namespace nt::test
