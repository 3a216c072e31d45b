// SPDX-License-Identifier: Apache-2.0
#include "core/deform/sparse_ldlt.h"

#include <algorithm>

namespace nt {
namespace {
constexpr uint16_t kNone = 0xffff;
}

void SparseLdlt::create(Arena& arena, std::span<const uint32_t> column_start, std::span<const uint16_t> rows) {
  const std::size_t n = column_start.size() - 1;
  start_ = column_start, rows_ = rows;
  lower_ = arena.take<float>(rows.size());
  diagonal_ = arena.take<float>(n);
  work_ = arena.take<float>(n);
  next_entry_ = arena.take<uint32_t>(n);
  waiting_ = arena.take<uint16_t>(n);
  sibling_ = arena.take<uint16_t>(n);
  inverse_ = arena.take<float>(n);
}

void SparseLdlt::clear() {
  std::fill(lower_.begin(), lower_.end(), 0.0f);
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0f);
}

void SparseLdlt::add(uint16_t i, uint16_t j, float v) {
  const uint16_t column = std::min(i, j), row = std::max(i, j);
  const auto first = rows_.begin() + start_[column], last = rows_.begin() + start_[column + 1u];
  const auto at = std::lower_bound(first, last, row);
  if (at != last && *at == row) lower_[static_cast<std::size_t>(at - rows_.begin())] += v;
}

// Takes from column j, scattered in work_, what the columns before it owe; returns what is left of its diagonal.
float SparseLdlt::gather(std::size_t j) {
  float d = diagonal_[j];
  const uint16_t* rows = rows_.data();
  const float* lower = lower_.data();
  float* work = work_.data();
  for (uint16_t k = waiting_[j]; k != kNone;) {
    const uint16_t after = sibling_[k];
    const uint32_t p = next_entry_[k], end = start_[k + 1u];
    const float f = lower[p] * diagonal_[k];
    d -= f * lower[p];
    for (uint32_t q = p + 1; q < end; ++q) work[rows[q]] -= lower[q] * f;
    if (p + 1 < end) {
      next_entry_[k] = p + 1;
      sibling_[k] = waiting_[rows[p + 1]];
      waiting_[rows[p + 1]] = k;
    }
    k = after;
  }
  return d;
}

bool SparseLdlt::factorise() {
  const std::size_t n = diagonal_.size();
  std::fill(waiting_.begin(), waiting_.end(), kNone);
  for (std::size_t j = 0; j < n; ++j) {
    const uint32_t first = start_[j], end = start_[j + 1];
    for (uint32_t p = first; p < end; ++p) work_[rows_[p]] = lower_[p];
    const float d = gather(j);
    if (!(d > 0.0f)) return false;
    const float inverse = 1.0f / d;
    diagonal_[j] = d;
    inverse_[j] = inverse;
    for (uint32_t p = first; p < end; ++p) lower_[p] = work_[rows_[p]] * inverse;
    if (first < end) {
      next_entry_[j] = first;
      sibling_[j] = waiting_[rows_[first]];
      waiting_[rows_[first]] = static_cast<uint16_t>(j);
    }
  }
  return true;
}

void SparseLdlt::solve(std::span<Float4> b) const {
  const std::size_t n = diagonal_.size();
  const uint16_t* rows = rows_.data();
  const float* lower = lower_.data();
  Float4* x = b.data();
  for (std::size_t j = 0; j < n; ++j) {
    const Float4 v = x[j];
    const uint32_t end = start_[j + 1];
    for (uint32_t p = start_[j]; p < end; ++p) x[rows[p]] -= splat4(lower[p]) * v;
  }
  for (std::size_t j = n; j-- > 0;) {
    // Two sums, because each addition waits for the one before it.
    Float4 even = splat4(0.0f), odd = splat4(0.0f);
    uint32_t p = start_[j];
    const uint32_t end = start_[j + 1];
    for (; p + 1 < end; p += 2) {
      even += splat4(lower[p]) * x[rows[p]];
      odd += splat4(lower[p + 1]) * x[rows[p + 1]];
    }
    if (p < end) even += splat4(lower[p]) * x[rows[p]];
    x[j] = x[j] * splat4(inverse_[j]) - (even + odd);
  }
}

}  // namespace nt
