// SPDX-License-Identifier: Apache-2.0
// The lattice solver's vertices, bit for bit the same on every target and with or without vector instructions.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

uint64_t run(LatticeForm form) {
  JointLimits limits;
  limits.y_min = limits.z_min = limits.twist_min = -0.2f;
  limits.y_max = limits.z_max = limits.twist_max = 0.15f;
  const LatticeData data = bar(17, 3, 4, 4, limits, form);
  Solver solver(data);
  Random random(9);
  uint64_t hash = kHashSeed;
  for (int f = 0; f < 60; ++f) {
    auto markers = bent_markers(solver.view(), 0.1f * det::sin(0.2f * static_cast<float>(f)));
    std::vector<uint8_t> seen(markers.size(), 1);
    for (std::size_t m = 0; m < markers.size(); ++m) {
      markers[m] += Vec3{random.unit(), random.unit(), random.unit()} * 0.05f;
      seen[m] = f < 30 || f >= 40 || m % 4 != 0;
    }
    solver->step(markers, seen);
    hash = hash_bytes(solver->vertices().data(), solver->vertices().size_bytes(), hash);
  }
  return hash;
}

std::string hex(uint64_t v) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(v));
  return text;
}

TEST(LatticeGolden, VerticesAreTheSameBitsEverywhere) {
  EXPECT_EQ(hex(run(LatticeForm::arap)), "5824139dbdc1cd74");
  EXPECT_EQ(hex(run(LatticeForm::stacked)), "8d73bc278d4aac83");
}

}  // namespace
}  // namespace nt::test
