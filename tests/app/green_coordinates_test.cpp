// SPDX-License-Identifier: Apache-2.0
#include "app/author/green_coordinates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/author/lattice_binding.h"
#include "core/base/random.h"
#include "core/deform/embed_green.h"

namespace nt {
namespace {

struct OneTet {
  std::vector<Vec3> vertices{{0, 0, 0}, {1, 0.1f, 0}, {0.2f, 1.1f, 0.1f}, {0.1f, 0.2f, 0.9f}};
  std::vector<uint16_t> tetrahedra{0, 1, 2, 3};
  std::vector<float> coordinates;
  std::vector<uint16_t> tetrahedron;
  std::vector<Vec3> points;
  explicit OneTet(int blocks) {
    Random random(3);
    for (int b = 0; b < blocks; ++b) {
      float weight[3][4];
      for (int lane = 0; lane < 4; ++lane) {
        float w[4], sum = 0;
        for (float& v : w) sum += v = 0.05f + random.unit();
        Vec3 p;
        for (std::size_t k = 0; k < 4; ++k) p += (w[k] / sum) * vertices[k];
        for (int k = 0; k < 3; ++k) weight[k][lane] = w[k + 1] / sum;
        points.push_back(p);
      }
      for (const auto& row : weight) coordinates.insert(coordinates.end(), row, row + 4);
      tetrahedron.push_back(0);
    }
  }
  EmbeddingView embedding() const { return {coordinates, tetrahedron}; }
  LatticeView lattice() const {
    LatticeView view;
    view.vertices = vertices, view.tetrahedra = tetrahedra;
    return view;
  }
  // The largest distance from `where` of a point.
  template <class F>
  float off(const std::vector<Vec3>& moved, F where) const {
    const auto green = green_embedding(embedding(), lattice());
    std::vector<float> out(12 * tetrahedron.size());
    embed_green(embedding(), green, lattice(), moved, out);
    float most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      most = std::max(most, length(Vec3{out[3 * i], out[3 * i + 1], out[3 * i + 2]} - where(points[i])));
    }
    return most;
  }
};

TEST(GreenCoordinates, AreOneInSumAndGiveThePointBack) {
  const OneTet t(20);
  for (const Vec3 p : t.points) {
    const auto c = green_coordinates({t.vertices[0], t.vertices[1], t.vertices[2], t.vertices[3]}, p);
    EXPECT_NEAR(c[0] + c[1] + c[2] + c[3], 1.0, 1e-6);
    for (int k = 4; k < 8; ++k) EXPECT_GT(c[static_cast<std::size_t>(k)], 0.0);
  }
  EXPECT_LT(t.off(t.vertices, [](Vec3 p) { return p; }), 1e-5f);
}

// What they promise: turns, shifts and even scales are carried over exactly.
TEST(GreenCoordinates, SimilaritiesAreExact) {
  const OneTet t(20);
  const Quat turn = normalised(Quat{0.4f, -0.2f, 0.7f, 0.3f});
  const auto similarity = [&](Vec3 p) { return 1.7f * rotate(turn, p) + Vec3{3, -2, 5}; };
  std::vector<Vec3> moved;
  for (const Vec3 p : t.vertices) moved.push_back(similarity(p));
  EXPECT_LT(t.off(moved, similarity), 1e-4f);
}

// And shape-preserving they are not linear: under a stretch the inside is not the barycentric one.
TEST(GreenCoordinates, AStretchIsNotLinear) {
  const OneTet t(20);
  const auto stretch = [](Vec3 p) { return Vec3{2 * p.x, p.y, p.z}; };
  std::vector<Vec3> moved;
  for (const Vec3 p : t.vertices) moved.push_back(stretch(p));
  const float off = t.off(moved, stretch);
  EXPECT_GT(off, 0.01f);
  EXPECT_LT(off, 0.5f);
}

TEST(GreenCoordinates, PointsOnFacesAndOutsideHaveSome) {
  const OneTet t(1);
  const std::array<Vec3, 4> corners = {t.vertices[0], t.vertices[1], t.vertices[2], t.vertices[3]};
  for (const Vec3 p : {t.vertices[0], 0.5f * (t.vertices[1] + t.vertices[2]), Vec3{2, 2, 2}}) {
    double sum = 0;
    for (const double c : green_coordinates(corners, p)) {
      ASSERT_TRUE(std::isfinite(c));
      sum += std::abs(c);
    }
    EXPECT_GT(sum, 0.5);
  }
}

}  // namespace
}  // namespace nt
