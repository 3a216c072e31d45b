// SPDX-License-Identifier: Apache-2.0
// The banded Whittaker smoother against a dense solve of the same normal equations in double.
#include "core/outline/smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/base/random.h"

namespace {

constexpr int n = nt::kStations;

Eigen::VectorXd dense(const nt::StationValues& values, const nt::StationValues& weights, double lambda) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n - 2, n);
  for (int i = 0; i < n - 2; ++i) d(i, i) = 1, d(i, i + 1) = -2, d(i, i + 2) = 1;
  Eigen::VectorXd w(n), y(n);
  for (int i = 0; i < n; ++i) w(i) = weights[static_cast<std::size_t>(i)], y(i) = values[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd a = Eigen::MatrixXd(w.asDiagonal()) + lambda * d.transpose() * d;
  return a.ldlt().solve(Eigen::VectorXd(w.cwiseProduct(y)));
}

TEST(SmootherOracle, EveryStiffnessAndGap) {
  nt::Random random(3);
  for (const float lambda : {0.01f, 1.0f, 60.0f, 1e4f}) {
    for (const uint32_t gaps : {1000u, 3u, 2u}) {
      nt::StationValues values, weights;
      for (float& v : values) v = 20 * random.unit() - 5;
      for (float& w : weights) w = random.below(gaps) == 0 ? 0.0f : random.unit() + 0.01f;
      const nt::StationValues ours = nt::smoothed(values, weights, lambda);
      const Eigen::VectorXd theirs = dense(values, weights, static_cast<double>(lambda));
      for (int i = 0; i < n; ++i)
        ASSERT_NEAR(ours[static_cast<std::size_t>(i)], theirs(i), 1e-3) << lambda << " " << gaps;
    }
  }
}

}  // namespace
