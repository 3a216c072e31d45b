// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/plain_mls.h"

#include <cmath>

namespace nt::test {

PlainMls::PlainMls(std::span<const Vec2> vertices, std::span<const Vec2> controls, float alpha, Precomputed precomputed)
    : alpha_(alpha), precomputed_(precomputed), q_(controls.size()) {
  for (const Vec2 v : vertices) v_.emplace_back(v.x, v.y);
  for (const Vec2 p : controls) p_.emplace_back(p.x, p.y);
  const std::size_t kept = precomputed == Precomputed::weights ? v_.size() : 1;
  w_.resize(kept * p_.size());
  a_.resize(kept * p_.size());
  p_star_.resize(kept);
  w_sum_.resize(kept);
  for (std::size_t v = 0; v < kept; ++v) prepare(v);
}

// Weights, centroid and the matrices of Eq 7, transposed for column vectors.
void PlainMls::prepare(std::size_t vertex) {
  const std::size_t slot = precomputed_ == Precomputed::weights ? vertex : 0, n = p_.size();
  float* w = w_.data() + slot * n;
  Eigen::Vector2f p_star = Eigen::Vector2f::Zero();
  float sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    w[i] = 1.0f / std::pow((p_[i] - v_[vertex]).squaredNorm(), alpha_);
    sum += w[i];
    p_star += w[i] * p_[i];
  }
  p_star /= sum;
  const Eigen::Vector2f d = v_[vertex] - p_star;
  Eigen::Matrix2f right;
  right << d.x(), d.y(), d.y(), -d.x();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2f ph = p_[i] - p_star;
    Eigen::Matrix2f left;
    left << ph.x(), ph.y(), ph.y(), -ph.x();
    a_[slot * n + i] = w[i] * (left * right).transpose();
  }
  p_star_[slot] = p_star;
  w_sum_[slot] = sum;
}

void PlainMls::deform(std::span<const Vec2> controls, std::span<Vec2> out) {
  const std::size_t n = p_.size();
  for (std::size_t i = 0; i < n; ++i) q_[i] = {controls[i].x, controls[i].y};
  for (std::size_t v = 0; v < v_.size(); ++v) {
    if (precomputed_ == Precomputed::nothing) prepare(v);
    const std::size_t slot = precomputed_ == Precomputed::weights ? v : 0;
    Eigen::Vector2f q_star = Eigen::Vector2f::Zero();
    for (std::size_t i = 0; i < n; ++i) q_star += w_[slot * n + i] * q_[i];
    q_star /= w_sum_[slot];
    Eigen::Vector2f f = Eigen::Vector2f::Zero();
    for (std::size_t i = 0; i < n; ++i) f += a_[slot * n + i] * (q_[i] - q_star);
    f = (v_[v] - p_star_[slot]).norm() * f.normalized() + q_star;
    out[v] = {f.x(), f.y()};
  }
}

}  // namespace nt::test
