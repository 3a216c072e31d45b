// SPDX-License-Identifier: Apache-2.0
// Rigid moving least squares written down from the paper's formulas in Eigen (Schaefer et al. 2006, Eqs 7, 8): what
// bench_deform compares core/deform/mls with. Single precision, column vectors as Eigen likes them.
//
// `Nothing` computes everything in every frame. `Weights` keeps what section 2.4 of the paper keeps from the rest pose: w_i,
// p* and the matrices A_i of every vertex.
#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

#include "core/base/vec2.h"

namespace nt::test {

enum class Precomputed { nothing, weights };

class PlainMls {
 public:
  PlainMls(std::span<const Vec2> vertices, std::span<const Vec2> controls, float alpha, Precomputed precomputed);
  void deform(std::span<const Vec2> controls, std::span<Vec2> out);

 private:
  void prepare(std::size_t vertex);

  float alpha_;
  Precomputed precomputed_;
  std::vector<Eigen::Vector2f> v_, p_, q_;
  // Of one vertex after the other, or of the current one only.
  std::vector<float> w_;
  std::vector<Eigen::Matrix2f> a_;
  std::vector<Eigen::Vector2f> p_star_;
  std::vector<float> w_sum_;
};

}  // namespace nt::test
