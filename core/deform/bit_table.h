// SPDX-License-Identifier: Apache-2.0
// A square table of bits, one row a vertex: which vertices of a graph are joined.
//
// Memory: vertices^2 / 8 bytes of the arena it is made in. Empty when the arena is full; see ok().
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"

namespace nt {

class BitTable {
 public:
  BitTable(Arena& arena, std::size_t n) : n_(n), words_((n + 63) / 64), bits_(arena.take<uint64_t>(n * words_)) {}
  bool ok() const { return bits_.size() == n_ * words_; }
  std::size_t size() const { return n_; }
  std::size_t words() const { return words_; }
  std::span<const uint64_t> row(std::size_t r) const { return bits_.subspan(r * words_, words_); }

  void set(std::size_t r, std::size_t c) { bits_[r * words_ + c / 64] |= uint64_t{1} << (c % 64); }
  void clear(std::size_t r, std::size_t c) { bits_[r * words_ + c / 64] &= ~(uint64_t{1} << (c % 64)); }
  bool at(std::size_t r, std::size_t c) const { return (bits_[r * words_ + c / 64] >> (c % 64) & 1) != 0; }
  void add_row(std::size_t to, std::size_t from) {
    for (std::size_t k = 0; k < words_; ++k) bits_[to * words_ + k] |= bits_[from * words_ + k];
  }
  void copy(const BitTable& from) { std::copy(from.bits_.begin(), from.bits_.end(), bits_.begin()); }

  std::size_t count(std::size_t r) const {
    std::size_t sum = 0;
    for (const uint64_t word : row(r)) sum += static_cast<std::size_t>(std::popcount(word));
    return sum;
  }
  // In both rows.
  std::size_t count_common(std::size_t r, std::size_t s) const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < words_; ++k) {
      sum += static_cast<std::size_t>(std::popcount(bits_[r * words_ + k] & bits_[s * words_ + k]));
    }
    return sum;
  }
  // Calls f(column) for every bit of a row, rising. f may change other rows.
  template <class F>
  void each(std::size_t r, F f) const {
    each_common(r, r, f);
  }
  // Of every bit that both rows have.
  template <class F>
  void each_common(std::size_t r, std::size_t s, F f) const {
    for (std::size_t k = 0; k < words_; ++k) {
      for (uint64_t word = bits_[r * words_ + k] & bits_[s * words_ + k]; word != 0; word &= word - 1) {
        f(k * 64 + static_cast<std::size_t>(std::countr_zero(word)));
      }
    }
  }

 private:
  std::size_t n_, words_;
  std::span<uint64_t> bits_;
};

// Joins the neighbours of v with each other and takes v out of the graph; its row then is its factor column.
inline void eliminate(BitTable& graph, std::size_t v) {
  graph.each(v, [&](std::size_t j) {
    graph.add_row(j, v);
    graph.clear(j, j);
    graph.clear(j, v);
  });
}

}  // namespace nt
