// SPDX-License-Identifier: Apache-2.0
// [L] Algorithm 1 as one would write it down with Eigen, in double: JacobiSVD rotations, SimplicialLDLT, absolute
// positions, no acceleration. The judge of core/deform/lattice, for its result and for its speed.
#pragma once
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/deform/lattice.h"

namespace nt::oracle {

using Vec = Eigen::Vector3d;

inline Vec vec(nt::Vec3 p) { return {p.x, p.y, p.z}; }

class LatticeOracle {
 public:
  LatticeOracle(const LatticeView& view, const LatticeSettings& settings) : view_(view), settings_(settings) {
    for (const Vec3 p : view.vertices) rest_.push_back(vec(p));
    make_weights();
    make_matrix();
    place(Eigen::Matrix3d::Identity(), Vec::Zero());
  }
  // The rest pose, turned and shifted.
  void place(const Eigen::Matrix3d& turn, const Vec& shift) {
    x_.resize(static_cast<Eigen::Index>(rest_.size()), 3);
    for (std::size_t i = 0; i < rest_.size(); ++i) x_.row(index(i)) = turn * rest_[i] + shift;
    turns_.assign(rest_.size(), turn);
  }
  void iterate(const std::vector<Vec3>& markers) {
    find_turns();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(index(rest_.size()), 3);
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      Vec delta = Vec::Zero();
      for (const auto& [j, w] : list_[i]) delta += 0.5 * w * (turns_[i] + turns_[j]) * (rest_[i] - rest_[j]);
      right.row(index(i)) = delta;
    }
    if (stacked()) right = laplacian_ * right;
    right *= shape_weight();
    for (std::size_t m = 0; m < markers.size(); ++m) {
      for (int k = 0; k < 4; ++k) {
        const MarkerBinding& b = view_.markers[m];
        right.row(b.vertex[k]) += settings_.w_u * settings_.w_u * b.weight[k] * vec(markers[m]).transpose();
      }
    }
    add_bones(right);
    x_ = solver_.solve(right);
  }
  Vec vertex(std::size_t i) const { return x_.row(index(i)); }
  double largest_distance(std::span<const Vec3> other) const {
    double most = 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) most = std::max(most, (vertex(i) - vec(other[i])).norm());
    return most;
  }
  double rms_distance(std::span<const Vec3> other) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) sum += (vertex(i) - vec(other[i])).squaredNorm();
    return std::sqrt(sum / static_cast<double>(rest_.size()));
  }
  double diagonal() const {
    Eigen::AlignedBox3d box;
    for (const Vec& p : rest_) box.extend(p);
    return box.diagonal().norm();
  }
  const std::vector<std::map<std::size_t, double>>& weights() const { return weights_; }

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  bool stacked() const { return view_.form == LatticeForm::stacked; }
  double shape_weight() const { return stacked() ? settings_.w_l * settings_.w_l : settings_.w_l; }

  // Eq 8 by its words: the dihedral angle opposite to each edge.
  void make_weights() {
    weights_.resize(rest_.size());
    for (std::size_t t = 0; t < view_.tetrahedra.size(); t += 4) {
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < a; ++b) {
          int others[2], count = 0;
          for (int k = 0; k < 4; ++k) {
            if (k != a && k != b) others[count++] = k;
          }
          const std::size_t i = view_.tetrahedra[t + a], j = view_.tetrahedra[t + b];
          const Vec c = rest_[view_.tetrahedra[t + others[0]]], d = rest_[view_.tetrahedra[t + others[1]]];
          const Vec u = (d - c).normalized();
          const Vec to_i = (rest_[i] - c) - u * u.dot(rest_[i] - c), to_j = (rest_[j] - c) - u * u.dot(rest_[j] - c);
          const double angle = std::acos(std::clamp(to_i.normalized().dot(to_j.normalized()), -1.0, 1.0));
          const double w = (d - c).norm() / std::tan(angle) / 6.0;
          weights_[i][j] += w;
          weights_[j][i] += w;
        }
      }
    }
    std::vector<double> magnitudes;
    for (const auto& row : weights_) {
      for (const auto& entry : row) magnitudes.push_back(std::abs(entry.second));
    }
    std::nth_element(magnitudes.begin(), magnitudes.begin() + index(magnitudes.size() / 2), magnitudes.end());
    const double median = magnitudes[magnitudes.size() / 2];
    for (auto& row : weights_) {
      for (auto& entry : row) entry.second = std::clamp(entry.second / median, 0.05, 20.0);
      list_.emplace_back(row.begin(), row.end());
    }
  }

  void make_matrix() {
    std::vector<Eigen::Triplet<double>> list;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      for (const auto& [j, w] : weights_[i]) {
        list.emplace_back(index(i), index(i), w);
        list.emplace_back(index(i), index(j), -w);
      }
    }
    laplacian_.resize(index(rest_.size()), index(rest_.size()));
    laplacian_.setFromTriplets(list.begin(), list.end());
    list.clear();
    for (const MarkerBinding& b : view_.markers) {
      for (int k = 0; k < 4; ++k) {
        for (int l = 0; l < 4; ++l) {
          list.emplace_back(b.vertex[k], b.vertex[l], settings_.w_u * settings_.w_u * b.weight[k] * b.weight[l]);
        }
      }
    }
    const SkeletonView& s = view_.skeleton;
    const double w = settings_.w_d * settings_.w_d;
    for (std::size_t j = 0; j < s.joints(); ++j) {
      for (uint32_t p = s.chain_start[j] + 1; p < s.chain_start[j + 1]; ++p) {
        const uint16_t a = s.chain[p - 1], b = s.chain[p];
        list.emplace_back(a, a, w), list.emplace_back(b, b, w), list.emplace_back(a, b, -w),
            list.emplace_back(b, a, -w);
      }
    }
    Eigen::SparseMatrix<double> constraints(laplacian_.rows(), laplacian_.cols());
    constraints.setFromTriplets(list.begin(), list.end());
    const Eigen::SparseMatrix<double> shape =
        stacked() ? Eigen::SparseMatrix<double>(laplacian_ * laplacian_) : laplacian_;
    solver_.compute(shape_weight() * shape + constraints);
  }

  void find_turns() {
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
      for (const auto& [j, w] : list_[i]) s += w * (rest_[i] - rest_[j]) * (vertex(i) - vertex(j)).transpose();
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
      Eigen::Matrix3d u = svd.matrixU();
      if ((svd.matrixV() * u.transpose()).determinant() < 0.0) u.col(2) *= -1.0;
      turns_[i] = svd.matrixV() * u.transpose();
    }
  }

  // Straight bones of constant length; joint limits are not the oracle's business.
  void add_bones(Eigen::MatrixXd& right) const {
    const SkeletonView& s = view_.skeleton;
    for (std::size_t j = 0; j < s.joints(); ++j) {
      Vec direction = Vec::Zero();
      for (uint32_t p = s.chain_start[j] + 1; p < s.chain_start[j + 1]; ++p) {
        direction += (vertex(s.chain[p]) - vertex(s.chain[p - 1])).normalized();
      }
      direction.normalize();
      for (uint32_t p = s.chain_start[j] + 1; p < s.chain_start[j + 1]; ++p) {
        const double length = (rest_[s.chain[p]] - rest_[s.chain[p - 1]]).norm();
        const Vec gamma = settings_.w_d * settings_.w_d * length * direction;
        right.row(s.chain[p]) += gamma.transpose();
        right.row(s.chain[p - 1]) -= gamma.transpose();
      }
    }
  }

  LatticeView view_;
  LatticeSettings settings_;
  std::vector<Vec> rest_;
  std::vector<std::map<std::size_t, double>> weights_;
  std::vector<std::vector<std::pair<std::size_t, double>>> list_;  // the same, for speed
  Eigen::SparseMatrix<double> laplacian_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  Eigen::MatrixXd x_;
  std::vector<Eigen::Matrix3d> turns_;
};

}  // namespace nt::oracle
