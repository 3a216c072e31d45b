// SPDX-License-Identifier: Apache-2.0
// Our moving least squares against the paper's closed forms written down as they stand, in double (Schaefer et al. 2006,
// Eqs 5-8 with the per-point matrices A_i; row vectors as in the paper).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/deform/mls.h"

namespace nt {
namespace {

using Row = Eigen::RowVector2d;
using Matrix = Eigen::Matrix2d;

Row perpendicular(const Row& p) { return {-p.y(), p.x()}; }

Row paper(const Row& v, const std::vector<Row>& p, const std::vector<Row>& q, MlsKind kind, double alpha) {
  std::vector<double> w;
  double sum = 0;
  Row p_star = Row::Zero(), q_star = Row::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    w.push_back(1.0 / std::pow((p[i] - v).squaredNorm(), alpha));
    sum += w[i], p_star += w[i] * p[i], q_star += w[i] * q[i];
  }
  p_star /= sum, q_star /= sum;
  if (kind == MlsKind::affine) {
    Matrix moment = Matrix::Zero();
    for (std::size_t i = 0; i < p.size(); ++i) moment += w[i] * (p[i] - p_star).transpose() * (p[i] - p_star);
    Row f = q_star;  // Eq 5
    for (std::size_t j = 0; j < p.size(); ++j) {
      const double a = (v - p_star) * moment.inverse() * (w[j] * (p[j] - p_star).transpose());
      f += a * (q[j] - q_star);
    }
    return f;
  }
  Row f = Row::Zero();
  double mu = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Row ph = p[i] - p_star, d = v - p_star;
    Matrix left, right;  // Eq 7
    left << ph, -perpendicular(ph);
    right << d, -perpendicular(d);
    f += (q[i] - q_star) * (w[i] * left * right.transpose());
    mu += w[i] * ph.squaredNorm();
  }
  if (kind == MlsKind::similarity) return f / mu + q_star;  // Eq 6
  return (v - p_star).norm() * f / f.norm() + q_star;       // Eq 8
}

TEST(MlsOracle, MatchesThePaperOnRandomHandles) {
  Random random(77);
  const auto points = [&](std::size_t n) {
    std::vector<Vec2> out(n);
    for (Vec2& x : out) x = {random.unit() * 400 - 200, random.unit() * 400 - 200};
    return out;
  };
  const auto rows = [](const std::vector<Vec2>& in) {
    std::vector<Row> out;
    for (const Vec2 x : in) out.emplace_back(x.x, x.y);
    return out;
  };
  for (const MlsKind kind : {MlsKind::rigid, MlsKind::similarity, MlsKind::affine}) {
    for (const float alpha : {1.0f, 1.5f, 2.0f}) {
      const auto v = points(200), p = points(20), q = points(20);
      Arena measure;
      (void)Mls::create(measure, v, p, kind, alpha);
      void* memory = std::aligned_alloc(kAlignment, measure.used());
      Arena arena({static_cast<std::byte*>(memory), measure.used()});
      std::vector<Vec2> out(v.size());
      Mls::create(arena, v, p, kind, alpha)->deform(q, out);
      const auto pr = rows(p), qr = rows(q), vr = rows(v);
      for (std::size_t i = 0; i < v.size(); ++i) {
        const Row f = paper(vr[i], pr, qr, kind, static_cast<double>(alpha));
        EXPECT_NEAR(out[i].x, f.x(), 0.01) << static_cast<int>(kind) << ' ' << alpha;
        EXPECT_NEAR(out[i].y, f.y(), 0.01);
      }
      std::free(memory);
    }
  }
}

}  // namespace
}  // namespace nt
