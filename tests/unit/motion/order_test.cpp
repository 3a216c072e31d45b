// SPDX-License-Identifier: Apache-2.0
#include "core/motion/order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using nt::OrderPass;
using nt::OrderStep;

std::vector<int> turned(const std::vector<OrderStep>& steps) {
  OrderPass pass;
  std::vector<uint8_t> bits;
  for (const OrderStep& s : steps) bits.push_back(pass.add(s));
  pass.trace_back(bits);
  return {bits.begin(), bits.end()};
}

double log_share(double x) { return -std::log1p(std::exp(-x)); }

// Every one of the 2^n paths.
std::vector<int> best_of_all(const std::vector<OrderStep>& steps) {
  double best = -std::numeric_limits<double>::infinity();
  std::vector<int> answer;
  for (unsigned path = 0; path < 1u << steps.size(); ++path) {
    const auto state = [&](std::size_t i) { return static_cast<int>(path >> i & 1u); };
    double sum = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      sum += (state(i) == 0 ? 0.5 : -0.5) * steps[i].evidence;
      if (i > 0) sum += log_share(state(i) == state(i - 1) ? steps[i].continues : -steps[i].continues);
    }
    if (sum <= best) continue;
    best = sum;
    answer.clear();
    for (std::size_t i = 0; i < steps.size(); ++i) answer.push_back(state(i));
  }
  return answer;
}

TEST(OrderPassTest, IsTheBestOfAllPaths) {
  std::mt19937 random(5);
  std::normal_distribution<float> evidence(0.0f, 1.0f), odds(0.0f, 3.0f);
  for (int run = 0; run < 50; ++run) {
    std::vector<OrderStep> steps(11);
    for (OrderStep& s : steps) s = {evidence(random), odds(random)};
    EXPECT_EQ(turned(steps), best_of_all(steps)) << run;
  }
}

TEST(OrderPassTest, AWrongStartIsTurnedFromItsFirstFrame) {
  // The live filter starts wrong and corrects itself in frame 20: there its order does not continue.
  std::vector<OrderStep> steps;
  for (int i = 0; i < 60; ++i) steps.push_back({i < 20 ? -0.3f : 0.4f, i == 20 ? -8.0f : 8.0f});
  const std::vector<int> out = turned(steps);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(out[static_cast<std::size_t>(i)], i < 20) << i;
}

TEST(OrderPassTest, AFalseTurnInTheMiddleIsUndone) {
  // Frames 30 to 39 are recorded the wrong way round; one of them even says otherwise.
  std::vector<OrderStep> steps;
  for (int i = 0; i < 80; ++i) {
    const bool wrong = i >= 30 && i < 40;
    steps.push_back({wrong ? (i == 34 ? 2.0f : -0.2f) : 0.3f, i == 30 || i == 40 ? -4.0f : 8.0f});
  }
  const std::vector<int> out = turned(steps);
  for (int i = 0; i < 80; ++i) EXPECT_EQ(out[static_cast<std::size_t>(i)], i >= 30 && i < 40) << i;
}

TEST(OrderPassTest, LoudNonsenseInOneFrameTurnsNothing) {
  std::vector<OrderStep> steps(40, OrderStep{0.5f, 8.0f});
  steps[17].evidence = -1e30f;
  for (const int t : turned(steps)) EXPECT_EQ(t, 0);
}

TEST(OrderPassTest, NothingKnownTurnsNothing) {
  for (const int t : turned(std::vector<OrderStep>(50))) EXPECT_EQ(t, 0);
  OrderPass pass;
  pass.trace_back({});
}

TEST(OrderPassTest, AHundredThousandFramesKeepTheirDigits) {
  std::vector<OrderStep> steps(100000, OrderStep{1.5f, 9.0f});
  for (std::size_t i = 0; i < 50000; ++i) steps[i].evidence = -1.5f;
  steps[50000].continues = -9.0f;
  const std::vector<int> out = turned(steps);
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_EQ(out[i], i < 50000) << i;
}

}  // namespace
