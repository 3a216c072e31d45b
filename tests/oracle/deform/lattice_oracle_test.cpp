// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/deform/lattice_oracle.h"

#include <gtest/gtest.h>

#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

LatticeSettings converging() {
  LatticeSettings s;
  s.max_iterations = 400;
  s.tolerance = 1e-8f;
  s.exact_bones = false;
  return s;
}

class LatticeOracleTest : public testing::TestWithParam<LatticeForm> {};

TEST_P(LatticeOracleTest, ConvergesToWhatEigenFindsInDouble) {
  for (const float bend : {0.03f, 0.12f}) {
    const LatticeData data = bar(12, 3, 3, 4, {}, GetParam());
    Solver solver(data, converging());
    const auto markers = bent_markers(solver.view(), bend);
    solver.step(markers);
    oracle::LatticeOracle oracle(solver.view(), converging());
    for (int k = 0; k < 600; ++k) oracle.iterate(markers);
    EXPECT_LT(oracle.largest_distance(solver->vertices()), 1e-4 * oracle.diagonal()) << bend;
    // Not by standing still: the rest pose is far away.
    EXPECT_GT(oracle.largest_distance(data.vertices), 0.02 * oracle.diagonal());
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, LatticeOracleTest, testing::Values(LatticeForm::arap, LatticeForm::stacked));

TEST(LatticeOracleTest, WeightsAreThoseOfTheAngles) {
  const LatticeData data = small_bar();
  const LatticeView view = data.view();
  const oracle::LatticeOracle oracle(view, {});
  for (std::size_t i = 0; i < view.vertices.size(); ++i) {
    for (uint32_t p = view.neighbour_start[i]; p < view.neighbour_start[i + 1]; ++p) {
      EXPECT_NEAR(view.weights[p], oracle.weights()[i].at(view.neighbours[p]), 1e-4);
    }
  }
}

}  // namespace
}  // namespace nt::test
