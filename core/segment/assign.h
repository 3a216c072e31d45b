// SPDX-License-Identifier: Apache-2.0
// Who gets what at the least cost in total: the linear assignment problem.
//
// cost[row * columns + column] -> for each row a column, or -1. A pair that costs `refused` or more is never made; leaving a
// row without a column costs `refused`. Deterministic: ties go to the lower column.
// Source: the Hungarian method with potentials (Kuhn 1955, Munkres 1957), row by row by shortest augmenting paths
// (Jonker and Volgenant 1987). Cost: O(rows^2 (rows + columns)), no memory beyond the stack: 3 KB.
#pragma once
#include <span>

namespace nt {

inline constexpr int kMostRows = 32, kMostColumns = 64;

void assign(std::span<const float> cost, int rows, int columns, float refused, std::span<int> column_of_row);

}  // namespace nt
