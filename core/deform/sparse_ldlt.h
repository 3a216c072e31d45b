// SPDX-License-Identifier: Apache-2.0
// A = L D L^T of a sparse symmetric positive definite matrix with a known pattern, and its solution for x, y, z at once.
//
// Input: the pattern of L (columns, strictly lower, rows rising, fill-in included) with the unknowns already in
// elimination order; A's values written into `lower` and `diagonal`. Output: the solution of A x = b in place.
// Left-looking factorisation (George and Liu 1981): column j gathers what the columns before it owe it, through a linked
// list of columns by their next row. Float: the callers solve for a small correction, so its error is theirs times 1e-4.
// Memory: 4 bytes an entry and 24 a column; the pattern is not copied.
// Cost: 2 passes over the entries a solution, 12 bytes of a right-hand side and 6 of the factor each.
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

  // Where to write A before `factorise`: entry p of `lower` is the pattern's, both zeroed here.
  void clear();
  void add_diagonal(std::size_t i, float v) { diagonal_[i] += v; }
  // Adds to the entry of row and column i, j (i != j); nothing where the pattern has none.
  void add(uint16_t i, uint16_t j, float v);
  // False if a pivot is not positive; the factor is then not to be used.
  bool factorise();
  // b has one entry a column, the fourth lane is spare.
  void solve(std::span<Float4> b) const;

 private:
  float gather(std::size_t j);

  std::span<const uint32_t> start_;
  std::span<const uint16_t> rows_;
  std::span<float> lower_, diagonal_, inverse_, work_;
  std::span<uint32_t> next_entry_;         // of a column: its first row that is not done
  std::span<uint16_t> waiting_, sibling_;  // columns whose next row is j, as a linked list
};

}  // namespace nt
