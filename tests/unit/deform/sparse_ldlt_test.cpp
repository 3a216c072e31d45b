// SPDX-License-Identifier: Apache-2.0
#include "core/deform/sparse_ldlt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

using Dense = std::vector<std::vector<double>>;

// A pattern with a matrix on it, in double too.
struct System {
  std::vector<uint32_t> start;
  std::vector<uint16_t> rows;
  Block block{1 << 21};
  SparseLdlt factor;
  std::vector<Float4> scratch;
  Dense dense;
  System(std::vector<uint32_t> column_start, std::vector<uint16_t> column_rows)
      : start(std::move(column_start)), rows(std::move(column_rows)) {
    const std::size_t n = start.size() - 1;
    Arena arena(block.span());
    factor.create(arena, start, rows);
    factor.clear();
    scratch.assign(n, splat4(1e30f));
    dense.assign(n, std::vector<double>(n));
  }
  void add(std::size_t i, std::size_t j, float v) {
    dense[i][j] += static_cast<double>(v);
    if (i == j) return factor.add_diagonal(i, v);
    dense[j][i] += static_cast<double>(v);
    factor.add(static_cast<uint16_t>(i), static_cast<uint16_t>(j), v);
  }
  // A pull between two unknowns, as an edge of a lattice makes it.
  void join(std::size_t i, std::size_t j, float v) { add(i, i, v), add(j, j, v), add(i, j, -v); }

  void expect_it_solves() {
    ASSERT_TRUE(factor.factorise(scratch));
    const std::size_t n = dense.size();
    Random r(4);
    std::vector<Float4> x(n), b(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = make4(r.unit(), r.unit(), r.unit(), 0.0f);
    for (std::size_t i = 0; i < n; ++i) {
      double sum[3] = {};
      for (std::size_t j = 0; j < n; ++j) {
        for (int c = 0; c < 3; ++c) sum[c] += dense[i][j] * static_cast<double>(x[j][c]);
      }
      b[i] = make4(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]), 0.0f);
    }
    factor.solve(b);
    for (std::size_t i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[i][c], x[i][c], 2e-5f) << i;
    }
  }
};

System of_lattice(const LatticeData& data) {
  System s(data.column_start, data.rows);
  for (std::size_t i = 0; i < data.vertices.size(); ++i) {
    for (uint32_t p = data.neighbour_start[i]; p < data.neighbour_start[i + 1]; ++p) {
      if (data.neighbours[p] > i) s.join(data.neighbours[p], i, data.weights[p]);
    }
    s.add(i, i, 1.0f);
  }
  return s;
}

// Every entry below the diagonal that `wanted` names, and what its elimination fills in.
template <class F>
System of_pattern(std::size_t n, F wanted) {
  std::vector<std::vector<bool>> full(n, std::vector<bool>(n));
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j + 1; i < n; ++i) full[i][j] = full[i][j] || wanted(i, j);
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = j + 1; k < i; ++k) full[i][k] = full[i][k] || (full[i][j] && full[k][j]);
    }
  }
  std::vector<uint32_t> start{0};
  std::vector<uint16_t> rows;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j + 1; i < n; ++i) {
      if (full[i][j]) rows.push_back(static_cast<uint16_t>(i));
    }
    start.push_back(static_cast<uint32_t>(rows.size()));
  }
  System s(start, rows);
  Random r(9);
  for (std::size_t j = 0; j < n; ++j) {
    s.add(j, j, 0.5f + r.unit());
    for (std::size_t i = j + 1; i < n; ++i) {
      if (wanted(i, j)) s.join(i, j, r.unit());
    }
  }
  return s;
}

TEST(SparseLdltTest, TheSolutionSolves) {
  for (const LatticeData& data : {bar(6, 3, 1, 3), bar(5, 5, 1, 4), bar(9, 1, 2, 3)}) {
    System s = of_lattice(data);
    s.expect_it_solves();
  }
}

// Panels of every width, alone and after whole ones; and none but single columns.
TEST(SparseLdltTest, PanelsOfEveryWidth) {
  for (std::size_t n = 1; n <= 13; ++n) {
    System all = of_pattern(n, [](std::size_t, std::size_t) { return true; });
    all.expect_it_solves();
  }
  for (std::size_t width = 1; width <= 5; ++width) {
    // Blocks of columns that meet in some rows of the blocks after them, so panels owe to parts of panels.
    System blocks = of_pattern(40, [&](std::size_t i, std::size_t j) {
      return i / width == j / width || (j / width % 2 == 0 && i % 3 == 0) || i > 37;
    });
    blocks.expect_it_solves();
  }
  System single = of_pattern(30, [](std::size_t i, std::size_t j) { return i == j + 2; });
  single.expect_it_solves();
}

TEST(SparseLdltTest, AnEntryOutsideThePatternIsLeftOut) {
  System s = of_pattern(6, [](std::size_t i, std::size_t j) { return i == j + 1; });
  s.factor.add(5, 0, 1e6f);
  s.expect_it_solves();
}

TEST(SparseLdltTest, ANegativePivotIsTold) {
  System s = of_lattice(bar(6, 3, 1, 3));
  s.factor.add_diagonal(7, -100.0f);
  EXPECT_FALSE(s.factor.factorise(s.scratch));
}

}  // namespace
}  // namespace nt::test
