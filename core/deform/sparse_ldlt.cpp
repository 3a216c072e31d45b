// SPDX-License-Identifier: Apache-2.0
#include "core/deform/sparse_ldlt.h"

#include <algorithm>

namespace nt {
namespace {

constexpr uint16_t kNone = 0xffff;

// Of the triangle inside a panel, column by column.
constexpr std::size_t triangle_slot(std::size_t width, std::size_t row, std::size_t column) {
  return column * (2 * width - column - 1) / 2 + row - column - 1;
}

// Solves L y = b for the kWidth columns at x and takes what they owe from the rows below.
template <std::size_t kWidth>
void forward(const float* values, std::span<const uint16_t> rows, Float4* first, Float4* x) {
  Float4 y[kWidth];
  for (std::size_t c = 0; c < kWidth; ++c) y[c] = first[c];
  for (std::size_t c = 0; c < kWidth; ++c) {
    for (std::size_t r = c + 1; r < kWidth; ++r) y[r] -= splat4(*values++) * y[c];
  }
  for (std::size_t c = 1; c < kWidth; ++c) first[c] = y[c];
  for (const uint16_t row : rows) {
    Float4 sum = x[row];
    for (std::size_t c = 0; c < kWidth; ++c) sum -= splat4(values[c]) * y[c];
    x[row] = sum;
    values += kWidth;
  }
}
template <>
void forward<4>(const float* values, std::span<const uint16_t> rows, Float4* first, Float4* x) {
  const Float4 y0 = first[0];
  const Float4 y1 = first[1] - splat4(values[0]) * y0;
  const Float4 y2 = first[2] - splat4(values[1]) * y0 - splat4(values[3]) * y1;
  const Float4 y3 = first[3] - splat4(values[2]) * y0 - splat4(values[4]) * y1 - splat4(values[5]) * y2;
  first[1] = y1, first[2] = y2, first[3] = y3;
  values += 6;
  for (const uint16_t row : rows) {
    const Float4 l = load4(values);
    x[row] = x[row] - broadcast4<0>(l) * y0 - broadcast4<1>(l) * y1 - broadcast4<2>(l) * y2 - broadcast4<3>(l) * y3;
    values += 4;
  }
}

template <std::size_t kWidth>
struct Sums {
  Float4 of[kWidth];
};
// Each column's row times x, two sums each, because each addition waits for the one before it.
template <std::size_t kWidth>
Sums<kWidth> row_sums(const float* values, std::span<const uint16_t> rows, const Float4* x) {
  Sums<kWidth> even, odd;
  for (std::size_t c = 0; c < kWidth; ++c) even.of[c] = odd.of[c] = splat4(0.0f);
  std::size_t r = 0;
  for (; r + 1 < rows.size(); r += 2, values += 2 * kWidth) {
    const Float4 a = x[rows[r]], b = x[rows[r + 1]];
    for (std::size_t c = 0; c < kWidth; ++c) even.of[c] += splat4(values[c]) * a;
    for (std::size_t c = 0; c < kWidth; ++c) odd.of[c] += splat4(values[kWidth + c]) * b;
  }
  if (r < rows.size()) {
    for (std::size_t c = 0; c < kWidth; ++c) even.of[c] += splat4(values[c]) * x[rows[r]];
  }
  for (std::size_t c = 0; c < kWidth; ++c) even.of[c] += odd.of[c];
  return even;
}
template <>
Sums<4> row_sums<4>(const float* values, std::span<const uint16_t> rows, const Float4* x) {
  Float4 s0 = splat4(0.0f), s1 = s0, s2 = s0, s3 = s0;
  for (const uint16_t row : rows) {
    const Float4 l = load4(values), at = x[row];
    s0 += broadcast4<0>(l) * at;
    s1 += broadcast4<1>(l) * at;
    s2 += broadcast4<2>(l) * at;
    s3 += broadcast4<3>(l) * at;
    values += 4;
  }
  return {{s0, s1, s2, s3}};
}

// Solves D L^T x = y for the kWidth columns at x.
template <std::size_t kWidth>
void backward(const float* values, const float* inverse, std::span<const uint16_t> rows, Float4* first,
              const Float4* x) {
  const Sums<kWidth> sums = row_sums<kWidth>(values + kWidth * (kWidth - 1) / 2, rows, x);
  for (std::size_t c = kWidth; c-- > 0;) {
    Float4 sum = sums.of[c];
    for (std::size_t r = c + 1; r < kWidth; ++r) sum += splat4(values[triangle_slot(kWidth, r, c)]) * first[r];
    first[c] = first[c] * splat4(inverse[c]) - sum;
  }
}

}  // namespace

// Calls f with each panel of the pattern. A column joins the one before it if that one's rows are its own and itself;
// as the pattern holds its fill-in, it is enough to count.
template <class F>
void SparseLdlt::each_panel(F f) const {
  Panel panel;
  const std::size_t n = start_.size() - 1;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t size = start_[j + 1] - start_[j];
    const bool joins =
        panel.width > 0 && panel.width < kWidest && start_[j] - start_[j - 1] == size + 1 && rows_[start_[j - 1]] == j;
    if (!joins) {
      if (panel.width > 0) f(panel);
      panel = {start_[j], static_cast<uint16_t>(j), 0};
    }
    ++panel.width;
  }
  if (panel.width > 0) f(panel);
}

void SparseLdlt::create(Arena& arena, std::span<const uint32_t> column_start, std::span<const uint16_t> rows) {
  const std::size_t n = column_start.size() - 1;
  start_ = column_start, rows_ = rows;
  std::size_t count = 0;
  each_panel([&](const Panel&) { ++count; });
  values_ = arena.take<float>(rows.size());
  diagonal_ = arena.take<float>(n);
  panel_of_ = arena.take<uint16_t>(n);
  panels_ = arena.take<Panel>(count);
  next_row_ = arena.take<uint32_t>(count);
  waiting_ = arena.take<uint16_t>(count);
  sibling_ = arena.take<uint16_t>(count);
  inverse_ = arena.take<float>(n);
  if (!ok()) return;
  std::size_t p = 0;
  each_panel([&](const Panel& panel) {
    for (std::size_t c = 0; c < panel.width; ++c) panel_of_[panel.first + c] = static_cast<uint16_t>(p);
    panels_[p++] = panel;
  });
}

void SparseLdlt::clear() {
  std::fill(values_.begin(), values_.end(), 0.0f);
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0f);
}

// Null where the pattern has none; row > column.
float* SparseLdlt::entry(std::size_t row, std::size_t column) {
  const Panel& p = panels_[panel_of_[column]];
  const std::size_t c = column - p.first;
  float* values = values_.data() + p.values;
  if (row - p.first < p.width) return values + triangle_slot(p.width, row - p.first, c);
  const auto rows = rows_of(p);
  const auto at = std::lower_bound(rows.begin(), rows.end(), row);
  if (at == rows.end() || *at != row) return nullptr;
  return values + p.triangle() + static_cast<std::size_t>(at - rows.begin()) * p.width + c;
}

void SparseLdlt::add(uint16_t i, uint16_t j, float v) {
  float* at = entry(std::max(i, j), std::min(i, j));
  if (at != nullptr) *at += v;
}

void SparseLdlt::queue(std::size_t panel, uint32_t next_row) {
  const auto rows = rows_of(panels_[panel]);
  if (next_row == rows.size()) return;
  next_row_[panel] = next_row;
  const uint16_t at = panel_of_[rows[next_row]];
  sibling_[panel] = waiting_[at];
  waiting_[at] = static_cast<uint16_t>(panel);
}

// The panel's part of A: of each row of it, its columns in the lanes.
void SparseLdlt::scatter(const Panel& p, Float4* work) const {
  const float* values = values_.data() + p.values;
  Float4* own = work + p.first;
  for (std::size_t c = 0; c < p.width; ++c) own[c] = splat4(0.0f);
  for (std::size_t c = 0; c < p.width; ++c) {
    own[c][static_cast<int>(c)] = diagonal_[p.first + c];
    for (std::size_t r = c + 1; r < p.width; ++r) own[r][static_cast<int>(c)] = *values++;
  }
  for (const uint16_t row : rows_of(p)) {
    Float4 v = splat4(0.0f);
    for (std::size_t c = 0; c < p.width; ++c) v[static_cast<int>(c)] = *values++;
    work[row] = v;
  }
}

// Takes from the panel, scattered in work, what the panels before it owe.
void SparseLdlt::gather(std::size_t panel, Float4* work) {
  const Panel& to = panels_[panel];
  for (uint16_t k = waiting_[panel]; k != kNone;) {
    const uint16_t after = sibling_[k];
    const Panel& from = panels_[k];
    const auto rows = rows_of(from);
    const std::size_t width = from.width;
    const float* values = values_.data() + from.values + from.triangle();
    const uint32_t begin = next_row_[k];
    uint32_t end = begin;
    Float4 owed[kWidest] = {splat4(0.0f), splat4(0.0f), splat4(0.0f), splat4(0.0f)};
    for (; end < rows.size() && rows[end] < to.first + to.width; ++end) {
      for (std::size_t c = 0; c < width; ++c) {
        owed[c][rows[end] - to.first] = values[end * width + c] * diagonal_[from.first + c];
      }
    }
    for (std::size_t r = begin; r < rows.size(); ++r) {
      Float4 sum = work[rows[r]];
      for (std::size_t c = 0; c < width; ++c) sum -= splat4(values[r * width + c]) * owed[c];
      work[rows[r]] = sum;
    }
    queue(k, end);
    k = after;
  }
}

// Factorises the panel in work, and writes it out.
bool SparseLdlt::eliminate(const Panel& p, Float4* work) {
  float* values = values_.data() + p.values;
  Float4* own = work + p.first;
  Float4 owed[kWidest];
  float inverse[kWidest];
  for (std::size_t c = 0; c < p.width; ++c) {
    const int lane = static_cast<int>(c);
    const float d = own[c][lane];
    if (!(d > 0.0f)) return false;
    inverse[c] = 1.0f / d;
    diagonal_[p.first + c] = d, inverse_[p.first + c] = inverse[c];
    owed[c] = splat4(0.0f);
    for (std::size_t r = c + 1; r < p.width; ++r) owed[c][static_cast<int>(r)] = own[r][lane];
    for (std::size_t r = c + 1; r < p.width; ++r) {
      *values = own[r][lane] * inverse[c];
      own[r] -= splat4(*values++) * owed[c];
    }
  }
  for (const uint16_t row : rows_of(p)) {
    Float4 v = work[row];
    for (std::size_t c = 0; c < p.width; ++c) {
      *values = v[static_cast<int>(c)] * inverse[c];
      v -= splat4(*values++) * owed[c];
    }
  }
  return true;
}

bool SparseLdlt::factorise(std::span<Float4> scratch) {
  std::fill(waiting_.begin(), waiting_.end(), kNone);
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    scatter(panels_[p], scratch.data());
    gather(p, scratch.data());
    if (!eliminate(panels_[p], scratch.data())) return false;
    queue(p, 0);
  }
  return true;
}

void SparseLdlt::solve(std::span<Float4> b) const {
  Float4* x = b.data();
  for (const Panel& p : panels_) {
    const float* values = values_.data() + p.values;
    switch (p.width) {
      case 1:
        forward<1>(values, rows_of(p), x + p.first, x);
        break;
      case 2:
        forward<2>(values, rows_of(p), x + p.first, x);
        break;
      case 3:
        forward<3>(values, rows_of(p), x + p.first, x);
        break;
      default:
        forward<4>(values, rows_of(p), x + p.first, x);
    }
  }
  for (std::size_t k = panels_.size(); k-- > 0;) {
    const Panel& p = panels_[k];
    const float *values = values_.data() + p.values, *inverse = inverse_.data() + p.first;
    switch (p.width) {
      case 1:
        backward<1>(values, inverse, rows_of(p), x + p.first, x);
        break;
      case 2:
        backward<2>(values, inverse, rows_of(p), x + p.first, x);
        break;
      case 3:
        backward<3>(values, inverse, rows_of(p), x + p.first, x);
        break;
      default:
        backward<4>(values, inverse, rows_of(p), x + p.first, x);
    }
  }
}

}  // namespace nt
