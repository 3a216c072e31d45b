// SPDX-License-Identifier: Apache-2.0
#include "core/deform/untangle.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

float least_volume(const LatticeView& v, const std::vector<Vec3>& x) {
  float least = 1.0f;
  for (std::size_t t = 0; t < v.tetrahedra.size(); t += 4) {
    const uint16_t* i = &v.tetrahedra[t];
    const float rest = volume6(v.vertices[i[0]], v.vertices[i[1]], v.vertices[i[2]], v.vertices[i[3]]);
    least = det::min(least, volume6(x[i[0]], x[i[1]], x[i[2]], x[i[3]]) / rest);
  }
  return least;
}

TEST(Untangle, LeavesWhatIsSoundAlone) {
  const LatticeData data = small_bar();
  std::vector<Vec3> x;
  for (const Vec3 p : data.vertices) x.push_back(bent(p, 0.05f));
  const std::vector<Vec3> before = x;
  const std::vector<uint8_t> held(x.size(), 0);
  EXPECT_EQ(untangle(data.view(), held, 10, x), 0);
  EXPECT_EQ(largest_step(x, before), 0.0f);
}

TEST(Untangle, TurnsTetrahedraBackAndHoldsWhatItMust) {
  const LatticeData data = small_bar();
  Random random(4);
  std::vector<uint8_t> held(data.vertices.size(), 0);
  for (const uint16_t v : data.chain) held[v] = 1;
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> x = data.vertices;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!held[i]) x[i] += Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f} * 1.2f;
    }
    const std::vector<Vec3> before = x;
    ASSERT_LT(least_volume(data.view(), x), 0.0f);
    EXPECT_EQ(untangle(data.view(), held, 400, x), 0) << round;
    EXPECT_GT(least_volume(data.view(), x), 0.9f * kLeastVolume);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_TRUE(held[i] == 0 || length(x[i] - before[i]) == 0.0f);
    }
  }
}

TEST(Untangle, SaysWhatItCannotDo) {
  const LatticeData data = bar(3, 1, 2, 1);
  std::vector<Vec3> x;
  for (const Vec3 p : data.vertices) x.push_back({-p.x, p.y, p.z});
  const std::vector<uint8_t> all(x.size(), 1);
  EXPECT_EQ(untangle(data.view(), all, 5, x), static_cast<int>(data.tetrahedra.size() / 4));
}

}  // namespace
}  // namespace nt::test
