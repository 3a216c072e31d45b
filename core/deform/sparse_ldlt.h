// SPDX-License-Identifier: Apache-2.0
// A = L D L^T of a sparse symmetric positive definite matrix with a known pattern, and its solution for x, y, z at once.
//
// Input: the pattern of L (columns, strictly lower, rows rising, fill-in included) with the unknowns already in
// elimination order; A's values added entry by entry. Output: the solution of A x = b in place.
// Columns that follow each other and have the same rows below them, up to four, are one panel: its values lie row by
// row, so that a row of x is read and written once for four columns, and a row of the factor is one vector.
// Left-looking factorisation (George and Liu 1981; by panels as Ng and Peyton, "Block sparse Cholesky algorithms on
// advanced uniprocessor computers", 1993): a panel gathers what the panels before it owe it, through a linked list of
// panels by their next row. Float: the callers solve for a small correction, so its error is theirs times 1e-4.
// Memory: 4 bytes an entry, 10 a column and 16 a panel; the pattern is not copied.
// Cost: 2 passes over the entries a solution.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/float4.h"

namespace nt {

class SparseLdlt {
 public:
  // Empty when the arena is measuring or full; see ok(). The pattern must outlive it.
  void create(Arena& arena, std::span<const uint32_t> column_start, std::span<const uint16_t> rows);
  bool ok() const { return !inverse_.empty(); }

  // A = 0.
  void clear();
  void add_diagonal(std::size_t i, float v) { diagonal_[i] += v; }
  // Adds to the entry of row and column i, j (i != j); nothing where the pattern has none.
  void add(uint16_t i, uint16_t j, float v);
  // False if a pivot is not positive; the factor is then not to be used. Scratch: one entry a column, in any state.
  bool factorise(std::span<Float4> scratch);
  // b has one entry a column, the fourth lane is spare.
  void solve(std::span<Float4> b) const;

 private:
  static constexpr std::size_t kWidest = 4;
  // Columns first .. first + width - 1. Its values: the triangle between them, column by column, then a row of `width`
  // for each of the rows that its last column lists.
  struct Panel {
    uint32_t values = 0;
    uint16_t first = 0, width = 0;
    std::size_t triangle() const { return width * (width - 1u) / 2u; }
  };
  template <class F>
  void each_panel(F f) const;
  std::span<const uint16_t> rows_of(const Panel& p) const {
    const std::size_t last = p.first + p.width - 1u;
    return rows_.subspan(start_[last], start_[last + 1] - start_[last]);
  }
  float* entry(std::size_t row, std::size_t column);
  void scatter(const Panel& p, Float4* work) const;
  void gather(std::size_t panel, Float4* work);
  bool eliminate(const Panel& p, Float4* work);
  void queue(std::size_t panel, uint32_t next_row);

  std::span<const uint32_t> start_;
  std::span<const uint16_t> rows_;
  std::span<float> values_;  // of A, then of L
  std::span<float> diagonal_, inverse_;
  std::span<uint16_t> panel_of_;  // of a column
  std::span<Panel> panels_;
  std::span<uint32_t> next_row_;           // of a panel: the first of its rows that is not done
  std::span<uint16_t> waiting_, sibling_;  // panels whose next row is in this one, as a linked list
};

}  // namespace nt
