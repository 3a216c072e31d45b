// SPDX-License-Identifier: Apache-2.0
#include "core/deform/lattice_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

TEST(LatticeViewTest, AWholeLatticePassesItsCheck) {
  for (const LatticeForm form : {LatticeForm::arap, LatticeForm::stacked}) {
    const LatticeData data = bar(6, 3, 2, 3, {}, form);
    const Status s = check_lattice(data.view(), Limits{});
    EXPECT_TRUE(s.ok()) << s.message;
  }
}

// A right-angled corner: the edge of length sqrt 2 opposite to the leg from the origin sees it under an angle whose
// cotangent follows from the box. Worked by hand for legs of 1: opposite to the leg along x lies the edge from y to z,
// of length sqrt 2, with cot = 1 / sqrt 2 between its two faces; 1/6 sqrt 2 / sqrt 2 = 1/6. Opposite to the edge from x to y
// lies the leg along z with a right angle: 0.
TEST(LatticeViewTest, WeightsOfARightAngledCorner) {
  const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<uint16_t> tet = {0, 1, 2, 3};
  Block out_block(65536), scratch_block(65536);
  Arena out(out_block.span()), scratch(scratch_block.span());
  const auto view = derive_lattice(out, scratch, corner, tet, LatticeForm::arap);
  ASSERT_TRUE(view.ok());
  // Median 1/6 by magnitude, so legs have 1 and the others the least that the clamp leaves.
  const auto weight = [&](std::size_t i, uint16_t j) {
    const LatticeView& v = view.value();
    for (uint32_t p = v.neighbour_start[i]; p < v.neighbour_start[i + 1]; ++p) {
      if (v.neighbours[p] == j) return v.weights[p];
    }
    return -1.0f;
  };
  EXPECT_NEAR(weight(0, 1), 1.0f, 1e-5f);
  EXPECT_NEAR(weight(2, 0), 1.0f, 1e-5f);
  EXPECT_NEAR(weight(1, 2), 0.05f, 1e-5f);
}

TEST(LatticeViewTest, TheOrderSavesFillIn) {
  const LatticeData data = small_bar();
  std::vector<uint16_t> place(data.vertices.size());
  Block block(data.vertices.size() * data.vertices.size());
  Arena scratch(block.span());
  ASSERT_TRUE(elimination_order(scratch, data.vertices.size(), data.tetrahedra, LatticeForm::arap, place));
  EXPECT_EQ(std::set<uint16_t>(place.begin(), place.end()).size(), place.size());
  // A band along the bar would need about 25 entries a column below the diagonal.
  EXPECT_LT(data.rows.size(), 26u * data.vertices.size());
}

TEST(LatticeViewTest, FlatTetrahedraAreRefused) {
  const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<uint16_t> tet = {0, 1, 2, 3};
  Block out_block(65536), scratch_block(65536);
  Arena out(out_block.span()), scratch(scratch_block.span());
  EXPECT_FALSE(derive_lattice(out, scratch, flat, tet, LatticeForm::arap).ok());
}

TEST(LatticeViewTest, DamageIsFound) {
  const LatticeData sound = bar(4, 1, 2, 2);
  const auto refused = [&](auto damage) {
    LatticeData d = sound;
    damage(d);
    return !check_lattice(d.view(), Limits{}).ok();
  };
  EXPECT_FALSE(refused([](LatticeData&) {}));
  EXPECT_TRUE(refused([](LatticeData& d) { d.tetrahedra[3] = 60000; }));
  EXPECT_TRUE(refused([](LatticeData& d) { std::swap(d.tetrahedra[0], d.tetrahedra[1]); }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.neighbours[5] = 60000; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.neighbour_start[2] = 60000; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.weights[0] = -1.0f; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.weights[0] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.weights[0] += 0.5f; }));  // the edge's other end has another
  EXPECT_TRUE(refused([](LatticeData& d) { d.rows[0] = 0; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.rows.pop_back(), d.column_start.back()--; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.column_start[1] = 60000; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.markers[0].vertex[0] = 60000; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.joint_parent[1] = 9; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.chain_start[1] = 2; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.chain[1] = d.chain[0]; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.limits[1].y_min = 9.0f; }));
  EXPECT_TRUE(refused([](LatticeData& d) { d.vertices[0].x = std::numeric_limits<float>::infinity(); }));
  Limits few;
  few.max_lattice_vertices = 10;
  EXPECT_FALSE(check_lattice(sound.view(), few).ok());
}

}  // namespace
}  // namespace nt::test
