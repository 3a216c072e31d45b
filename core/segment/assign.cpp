// SPDX-License-Identifier: Apache-2.0
#include "core/segment/assign.h"

#include <array>

#include "core/base/image_view.h"

namespace nt {
namespace {

// Columns past the real ones stand for "nobody": one a row, so that every row can be placed. Index 0 is the method's own.
constexpr int kWide = kMostColumns + kMostRows + 1;

struct Work {
  std::span<const float> cost;
  int rows, columns;
  float refused;
  std::array<float, kMostRows + 1> row_potential{};
  std::array<float, kWide> column_potential{};
  std::array<int, kWide> row_of{};  // 0: free

  float price(int row, int column) const {  // both from 1
    if (column > columns) return refused;
    const float c = cost[static_cast<std::size_t>((row - 1) * columns + column - 1)];
    return c < refused ? c : 4.0f * refused;
  }
  void place(int row);
};

void Work::place(int row) {
  constexpr float kFar = 1e30f;
  const int wide = columns + rows;
  std::array<float, kWide> reach;
  std::array<int, kWide> way{};
  std::array<bool, kWide> done{};
  reach.fill(kFar);
  row_of[0] = row;
  int at = 0;
  do {
    done[static_cast<std::size_t>(at)] = true;
    const int r = row_of[static_cast<std::size_t>(at)];
    float least = kFar;
    int next = 0;
    for (int j = 1; j <= wide; ++j) {
      const auto c = static_cast<std::size_t>(j);
      if (done[c]) continue;
      const float reduced = price(r, j) - row_potential[static_cast<std::size_t>(r)] - column_potential[c];
      if (reduced < reach[c]) reach[c] = reduced, way[c] = at;
      if (reach[c] < least) least = reach[c], next = j;
    }
    for (int j = 0; j <= wide; ++j) {
      const auto c = static_cast<std::size_t>(j);
      if (done[c]) row_potential[static_cast<std::size_t>(row_of[c])] += least, column_potential[c] -= least;
      else reach[c] -= least;
    }
    at = next;
  } while (row_of[static_cast<std::size_t>(at)] != 0);
  for (; at != 0; at = way[static_cast<std::size_t>(at)])
    row_of[static_cast<std::size_t>(at)] = row_of[static_cast<std::size_t>(way[static_cast<std::size_t>(at)])];
}

}  // namespace

void assign(std::span<const float> cost, int rows, int columns, float refused, std::span<int> column_of_row) {
  rows = min_int(rows, kMostRows);
  for (int& column : column_of_row) column = -1;
  Work work{cost, rows, min_int(columns, kMostColumns), refused};
  for (int row = 1; row <= rows; ++row) work.place(row);
  for (int j = 1; j <= work.columns; ++j) {
    const int row = work.row_of[static_cast<std::size_t>(j)];
    if (row > 0 && work.price(row, j) < refused) column_of_row[static_cast<std::size_t>(row - 1)] = j - 1;
  }
}

}  // namespace nt
