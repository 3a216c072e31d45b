// SPDX-License-Identifier: Apache-2.0
#include "core/segment/assign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/base/random.h"

namespace nt {
namespace {

constexpr float kRefused = 10;

float total(const std::vector<float>& cost, int columns, std::span<const int> column_of_row) {
  float sum = 0;
  for (std::size_t r = 0; r < column_of_row.size(); ++r) {
    const int c = column_of_row[r];
    sum += c < 0 ? kRefused : cost[r * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  }
  return sum;
}

// Every way there is.
float least_total(const std::vector<float>& cost, int rows, int columns) {
  std::vector<int> order(static_cast<std::size_t>(columns + rows));
  std::iota(order.begin(), order.end(), 0);
  float best = 1e9f;
  do {
    std::vector<int> chosen;
    for (int r = 0; r < rows; ++r) {
      const int c = order[static_cast<std::size_t>(r)];
      const bool real = c < columns && cost[static_cast<std::size_t>(r * columns + c)] < kRefused;
      chosen.push_back(real ? c : -1);
    }
    best = std::min(best, total(cost, columns, chosen));
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assign, TheBestOfAllIsNotTheBestOfEach) {
  // The first row's favourite is the only one that the second can have.
  const std::vector<float> cost{1, 2, 1.5f, kRefused};
  std::array<int, 2> column{};
  assign(cost, 2, 2, kRefused, column);
  EXPECT_EQ(column[0], 1);
  EXPECT_EQ(column[1], 0);
}

TEST(Assign, APairThatIsRefusedIsNeverMade) {
  const std::vector<float> cost{kRefused, kRefused + 5, 3, kRefused};
  std::array<int, 2> column{};
  assign(cost, 2, 2, kRefused, column);
  EXPECT_EQ(column[0], -1);
  EXPECT_EQ(column[1], 0);
}

TEST(Assign, NoColumnsAndNoRows) {
  std::array<int, 3> column{7, 7, 7};
  assign({}, 3, 0, kRefused, column);
  for (const int c : column) EXPECT_EQ(c, -1);
  assign({}, 0, 5, kRefused, {});
}

TEST(Assign, AsGoodAsTryingEverything) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    const int rows = 1 + static_cast<int>(random.next() % 4), columns = 1 + static_cast<int>(random.next() % 4);
    std::vector<float> cost;
    for (int i = 0; i < rows * columns; ++i)
      cost.push_back(static_cast<float>(random.next() % 1500) / 100.0f - 2.0f);  // some refused, some below 0
    std::vector<int> column(static_cast<std::size_t>(rows));
    assign(cost, rows, columns, kRefused, column);
    EXPECT_NEAR(total(cost, columns, column), least_total(cost, rows, columns), 1e-3f) << round;
    std::vector<int> taken;
    for (const int c : column)
      if (c >= 0) taken.push_back(c);
    std::sort(taken.begin(), taken.end());
    EXPECT_EQ(std::unique(taken.begin(), taken.end()), taken.end()) << "nobody shares";
  }
}

TEST(Assign, TheMostThatThereIsRoomFor) {
  std::vector<float> cost;
  for (int r = 0; r < kMostRows; ++r)
    for (int c = 0; c < kMostColumns; ++c) cost.push_back(static_cast<float>((r + c) % kMostColumns) / 10.0f);
  std::array<int, kMostRows> column{};
  assign(cost, kMostRows, kMostColumns, kRefused, column);
  EXPECT_NEAR(total(cost, kMostColumns, column), 0, 1e-3f);
}

}  // namespace
}  // namespace nt
