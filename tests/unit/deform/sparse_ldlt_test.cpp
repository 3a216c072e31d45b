// SPDX-License-Identifier: Apache-2.0
#include "core/deform/sparse_ldlt.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

struct System {
  LatticeData data = bar(6, 3, 1, 3);
  Block block{1 << 20};
  SparseLdlt factor;
  std::vector<std::vector<double>> dense;
  System() {
    Arena arena(block.span());
    factor.create(arena, data.column_start, data.rows);
    factor.clear();
    const std::size_t n = data.vertices.size();
    dense.assign(n, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i) {
      for (uint32_t p = data.neighbour_start[i]; p < data.neighbour_start[i + 1]; ++p) {
        const uint16_t j = data.neighbours[p];
        dense[i][i] += data.weights[p], dense[i][j] -= data.weights[p];
        factor.add_diagonal(i, data.weights[p]);
        if (i < j) factor.add(static_cast<uint16_t>(i), j, -data.weights[p]);
      }
      dense[i][i] += 1.0;
      factor.add_diagonal(i, 1.0f);
    }
  }
};

TEST(SparseLdltTest, TheSolutionSolves) {
  System s;
  ASSERT_TRUE(s.factor.factorise());
  const std::size_t n = s.dense.size();
  Random r(4);
  std::vector<Float4> x(n), b(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = make4(r.unit(), r.unit(), r.unit(), 0.0f);
  for (std::size_t i = 0; i < n; ++i) {
    double sum[3] = {};
    for (std::size_t j = 0; j < n; ++j) {
      for (int c = 0; c < 3; ++c) sum[c] += s.dense[i][j] * x[j][c];
    }
    b[i] = make4(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]), 0.0f);
  }
  s.factor.solve(b);
  for (std::size_t i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[i][c], x[i][c], 2e-5f);
  }
}

TEST(SparseLdltTest, ANegativePivotIsTold) {
  System s;
  s.factor.add_diagonal(7, -100.0f);
  EXPECT_FALSE(s.factor.factorise());
}

}  // namespace
}  // namespace nt::test
