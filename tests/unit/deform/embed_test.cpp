// SPDX-License-Identifier: Apache-2.0
#include "core/deform/embed.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

struct Embedded {
  LatticeData data = bar(6, 3, 1, 3);
  std::vector<float> coordinates;
  std::vector<uint16_t> tetrahedron;
  std::vector<Vec3> rest;  // of the detail vertices
  Embedded() {
    Random r(6);
    for (std::size_t t = 0; t < data.tetrahedra.size() / 4; ++t) {
      for (std::size_t block = 0; block < t % 3; ++block) {
        float b[12];
        for (int v = 0; v < 4; ++v) {
          float w[4], sum = 0.0f;
          for (float& x : w) sum += x = r.unit() + 0.01f;
          Vec3 p;
          for (int k = 0; k < 4; ++k) {
            p += w[k] / sum * data.vertices[data.tetrahedra[4 * t + static_cast<std::size_t>(k)]];
            if (k > 0) b[4 * (k - 1) + v] = w[k] / sum;
          }
          rest.push_back(p);
        }
        coordinates.insert(coordinates.end(), b, b + 12);
        tetrahedron.push_back(static_cast<uint16_t>(t));
      }
    }
  }
  EmbeddingView view() const { return {coordinates, tetrahedron}; }
  template <class F>
  std::vector<Vec3> moved(F f) const {
    std::vector<Vec3> out;
    for (const Vec3 p : data.vertices) out.push_back(f(p));
    return out;
  }
  std::vector<float> linear(const std::vector<Vec3>& x) const {
    std::vector<float> out(3 * rest.size());
    embed_linear(view(), data.view(), x, out);
    return out;
  }
  std::vector<float> phong(const std::vector<Vec3>& x) const {
    Arena measure;
    EXPECT_EQ(PhongEmbedding::create(measure, view(), data.view()), nullptr);
    Block block(measure.used());
    Arena arena(block.span());
    std::vector<float> out(3 * rest.size());
    PhongEmbedding::create(arena, view(), data.view())->embed(x, out);
    return out;
  }
  template <class F>
  float rms_error(const std::vector<float>& out, F f) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      sum += length_sq(Vec3{out[3 * i], out[3 * i + 1], out[3 * i + 2]} - f(rest[i]));
    }
    return static_cast<float>(det::sqrt(sum / static_cast<double>(rest.size())));
  }
};

TEST(EmbedTest, AffineMapsAreExact) {
  const Embedded e;
  ASSERT_GT(e.rest.size(), 400u);
  const auto map = [](Vec3 p) { return Vec3{1 + 2 * p.x - p.y, 3 + 0.5f * p.z + p.y, p.x - p.z + 0.2f * p.y}; };
  EXPECT_LT(e.rms_error(e.linear(e.moved(map)), map), 1e-5f);
  EXPECT_LT(e.rms_error(e.phong(e.moved(map)), map), 1e-5f);
}

TEST(EmbedTest, PhongIsNearerToABendThanLinear) {
  const Embedded e;
  const auto map = [](Vec3 p) { return bent(p, 0.25f); };
  const float linear = e.rms_error(e.linear(e.moved(map)), map), phong = e.rms_error(e.phong(e.moved(map)), map);
  EXPECT_LT(phong, 0.6f * linear);
  EXPECT_GT(phong, 0.0f);
}

// Both sides of an inner face give the same place: detail vertices on a face, bound to either tetrahedron.
TEST(EmbedTest, PhongIsContinuousAcrossFaces) {
  Embedded e;
  const auto& tets = e.data.tetrahedra;
  Random r(8);
  std::vector<Vec3> x = e.moved([](Vec3 p) { return bent(p, 0.2f); });
  for (Vec3& p : x) p += Vec3{r.unit(), r.unit(), r.unit()} * 0.3f;
  int pairs = 0;
  for (std::size_t s = 0; s < tets.size() / 4 && pairs < 50; ++s) {
    for (std::size_t t = s + 1; t < tets.size() / 4; ++t) {
      std::vector<uint16_t> common;
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
          if (tets[4 * s + static_cast<std::size_t>(i)] == tets[4 * t + static_cast<std::size_t>(j)]) {
            common.push_back(tets[4 * s + static_cast<std::size_t>(i)]);
          }
        }
      }
      if (common.size() != 3) continue;
      e.coordinates.clear();
      e.tetrahedron = {static_cast<uint16_t>(s), static_cast<uint16_t>(t)};
      e.rest.resize(8);
      const float w[3] = {0.2f, 0.3f, 0.5f};
      for (const std::size_t tet : {s, t}) {
        float b[12] = {};
        for (int v = 0; v < 4; ++v) {
          for (int k = 1; k < 4; ++k) {
            const auto at = std::find(common.begin(), common.end(), tets[4 * tet + static_cast<std::size_t>(k)]);
            if (at != common.end()) b[4 * (k - 1) + v] = w[at - common.begin()];
          }
        }
        e.coordinates.insert(e.coordinates.end(), b, b + 12);
      }
      const auto out = e.phong(x);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(out[static_cast<std::size_t>(c)], out[static_cast<std::size_t>(12 + c)], 1e-4f);
      ++pairs;
    }
  }
  EXPECT_GE(pairs, 50);
}

TEST(EmbedTest, DamageIsFound) {
  Embedded e;
  EXPECT_TRUE(check_embedding(e.view(), e.data.view()).ok());
  std::swap(e.tetrahedron.front(), e.tetrahedron.back());
  EXPECT_FALSE(check_embedding(e.view(), e.data.view()).ok());
  std::swap(e.tetrahedron.front(), e.tetrahedron.back());
  e.tetrahedron.back() = 60000;
  EXPECT_FALSE(check_embedding(e.view(), e.data.view()).ok());
  e.tetrahedron.pop_back();
  EXPECT_FALSE(check_embedding(e.view(), e.data.view()).ok());
}

}  // namespace
}  // namespace nt::test
