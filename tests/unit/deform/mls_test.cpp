// SPDX-License-Identifier: Apache-2.0
#include "core/deform/mls.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "core/base/det_math.h"
#include "core/base/random.h"

namespace nt {
namespace {

constexpr MlsKind kKinds[] = {MlsKind::rigid, MlsKind::similarity, MlsKind::affine};

class Deformer {
 public:
  Deformer(const std::vector<Vec2>& v, const std::vector<Vec2>& p, MlsKind kind, float alpha = 1.0f, float thin = 0.0f)
      : out_(v.size()) {
    Arena measure;
    EXPECT_EQ(Mls::create(measure, v, p, kind, alpha, thin), nullptr);
    memory_.resize(measure.used() + kAlignment);
    auto* at = reinterpret_cast<std::byte*>(align_up(reinterpret_cast<std::size_t>(memory_.data())));
    Arena arena({at, measure.used()});
    mls_ = Mls::create(arena, v, p, kind, alpha, thin);
    EXPECT_FALSE(arena.full());
    EXPECT_EQ(arena.used(), measure.used());
  }
  const std::vector<Vec2>& operator()(const std::vector<Vec2>& q) {
    mls_->deform(q, out_);
    return out_;
  }
  const Mls& mls() const { return *mls_; }

 private:
  std::vector<std::byte> memory_;
  Mls* mls_ = nullptr;
  std::vector<Vec2> out_;
};

std::vector<Vec2> random_points(std::size_t n, uint64_t seed, float size = 100.0f) {
  Random random(seed);
  std::vector<Vec2> out(n);
  for (Vec2& p : out) p = {(random.unit() - 0.5f) * size, (random.unit() - 0.5f) * size};
  return out;
}

template <class F>
std::vector<Vec2> mapped(const std::vector<Vec2>& points, F f) {
  std::vector<Vec2> out;
  for (const Vec2 p : points) out.push_back(f(p));
  return out;
}

void expect_near(const std::vector<Vec2>& a, const std::vector<Vec2>& b, float tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i].x, b[i].x, tolerance) << i;
    ASSERT_NEAR(a[i].y, b[i].y, tolerance) << i;
  }
}

TEST(Mls, RestPoseStaysWhereItIs) {
  const auto v = random_points(103, 1), p = random_points(9, 2);
  for (const MlsKind kind : kKinds) {
    for (const float alpha : {0.8f, 1.0f, 1.5f, 3.0f}) {
      Deformer d(v, p, kind, alpha);
      expect_near(d(p), v, 2e-4f);
    }
  }
}

TEST(Mls, ReproducesTheMotionsOfItsKind) {
  const auto v = random_points(61, 3), p = random_points(7, 4);
  const det::SinCos a = det::sincos(1.1f);
  const auto rigid = [&](Vec2 x) { return Vec2{a.cos * x.x - a.sin * x.y + 5, a.sin * x.x + a.cos * x.y - 8}; };
  const auto similar = [&](Vec2 x) { return rigid(x) * 1.7f; };
  const auto affine = [](Vec2 x) { return Vec2{1.3f * x.x + 0.4f * x.y - 3, -0.2f * x.x + 0.6f * x.y + 9}; };
  for (const MlsKind kind : kKinds) {
    Deformer d(v, p, kind);
    expect_near(d(mapped(p, rigid)), mapped(v, rigid), 5e-4f);
    if (kind != MlsKind::rigid) expect_near(d(mapped(p, similar)), mapped(v, similar), 5e-4f);
    if (kind == MlsKind::affine) expect_near(d(mapped(p, affine)), mapped(v, affine), 5e-4f);
  }
}

TEST(Mls, AVertexOnAControlPointGoesWithItExactly) {
  auto v = random_points(11, 5);
  const auto p = random_points(6, 6);
  v[4] = p[2];
  v[10] = p[5];
  const auto q = random_points(6, 7);
  for (const MlsKind kind : kKinds) {
    Deformer d(v, p, kind);
    const auto& out = d(q);
    EXPECT_EQ(out[4].x, q[2].x);
    EXPECT_EQ(out[4].y, q[2].y);
    EXPECT_EQ(out[10].x, q[5].x);
  }
}

TEST(Mls, ControlPointsInTheSamePlaceAreOne) {
  const auto v = random_points(20, 8);
  auto p = random_points(5, 9);
  p.push_back(p[0]);
  auto w = v;
  w[3] = p[0];
  auto q = mapped(p, [](Vec2 x) { return x + Vec2{3, 4}; });
  for (const MlsKind kind : kKinds) {
    Deformer d(w, p, kind);
    expect_near(d(q), mapped(w, [](Vec2 x) { return x + Vec2{3, 4}; }), 3e-4f);
  }
}

TEST(Mls, CollinearControlPointsBendTheirSurroundings) {
  std::vector<Vec2> p, q;
  for (int i = 0; i < 6; ++i) p.push_back({0, 10.0f * static_cast<float>(i)});
  const auto v = random_points(40, 10, 60);
  const auto turned = [](Vec2 x) { return Vec2{-x.y, x.x}; };
  for (const MlsKind kind : kKinds) {
    Deformer d(v, p, kind);
    expect_near(d(mapped(p, turned)), mapped(v, turned), 3e-4f);
  }
}

// On thin spreads affine goes over into the similarity: a pull along the line no longer tears what lies beside it.
TEST(Mls, AffineOnThinSpreadsIsTheSimilarity) {
  std::vector<Vec2> p, q;
  for (int i = 0; i < 6; ++i) p.push_back({i % 2 == 0 ? 0.05f : -0.05f, 10.0f * static_cast<float>(i)});
  for (const Vec2 x : p) q.push_back({10 * x.x + 1, 1.1f * x.y});
  const auto v = random_points(40, 10, 60);
  Deformer thin(v, p, MlsKind::affine, 1.5f, 0.15f), similar(v, p, MlsKind::similarity, 1.5f);
  Deformer pure(v, p, MlsKind::affine, 1.5f);
  expect_near(thin(q), similar(q), 1e-5f);
  float most = 0;
  for (std::size_t i = 0; i < v.size(); ++i) most = det::max(most, length(pure(q)[i] - similar(q)[i]));
  EXPECT_GT(most, 20.0f);
}

TEST(Mls, OneControlPointCarriesEverythingAlong) {
  const auto v = random_points(9, 11);
  for (const MlsKind kind : kKinds) {
    Deformer d(v, {{2, 3}}, kind);
    expect_near(d({{7, 1}}), mapped(v, [](Vec2 x) { return x + Vec2{5, -2}; }), 1e-5f);
  }
}

TEST(Mls, AllMovedToOnePlaceIsFinite) {
  const auto v = random_points(17, 12), p = random_points(5, 13);
  for (const MlsKind kind : kKinds) {
    Deformer d(v, p, kind);
    for (const Vec2 o : d(std::vector<Vec2>(5, Vec2{1, 2}))) {
      EXPECT_TRUE(o.x - o.x == 0.0f && o.y - o.y == 0.0f);
    }
  }
}

TEST(Mls, SimdMatchesThePlainVersionBitForBit) {
  for (const MlsKind kind : kKinds) {
    for (const std::size_t n : {1u, 7u, 8u, 9u, 250u}) {
      const auto v = random_points(n, 14 + n), p = random_points(13, 15);
      Deformer d(v, p, kind, 1.5f);
      for (uint64_t seed = 0; seed < 20; ++seed) {
        const auto q = random_points(13, 100 + seed);
        const auto& fast = d(q);
        std::vector<Vec2> plain(n);
        d.mls().deform_reference(q, plain);
        ASSERT_EQ(std::memcmp(fast.data(), plain.data(), n * sizeof(Vec2)), 0);
      }
    }
  }
}

TEST(Mls, NoRoomGivesNull) {
  alignas(64) std::byte memory[256];
  Arena arena(memory);
  const auto v = random_points(100, 1), p = random_points(5, 2);
  EXPECT_EQ(Mls::create(arena, v, p, MlsKind::rigid, 1), nullptr);
}

}  // namespace
}  // namespace nt
