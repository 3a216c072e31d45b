// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/arap.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace nt::test {
namespace {

constexpr double kPinWeight = 1000;  // AnimatedDrawings' own

Eigen::Vector2d point(Vec2 p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Arap::Arap(std::span<const Vec2> vertices, std::span<const uint32_t> triangles, std::span<const Vec2> handles) {
  rest_.resize(static_cast<Eigen::Index>(vertices.size()), 2);
  for (std::size_t i = 0; i < vertices.size(); ++i) rest_.row(static_cast<Eigen::Index>(i)) = point(vertices[i]);
  find_edges(triangles);
  place_pins(triangles, handles);
  factorise();
}

void Arap::find_edges(std::span<const uint32_t> triangles) {
  std::map<std::pair<int, int>, std::size_t> known;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = static_cast<int>(triangles[t + k]), b = static_cast<int>(triangles[t + (k + 1) % 3]);
      const int opposite = static_cast<int>(triangles[t + (k + 2) % 3]);
      const auto [it, added] = known.try_emplace({std::min(a, b), std::max(a, b)}, edges_.size());
      if (added) edges_.push_back(Edge{{a, b, opposite, opposite}});
      else edges_[it->second].vertex[3] = opposite, edges_[it->second].count = 4;
    }
  }
  for (Edge& edge : edges_) fit_edge(edge);
}

// v' = [c s; -s c] v for every neighbour, least squares about the places themselves as in the source.
void Arap::fit_edge(Edge& edge) const {
  Eigen::Matrix<double, 8, 2> g = Eigen::Matrix<double, 8, 2>::Zero();
  const Eigen::Vector2d origin = rest_.row(edge.vertex[0]).transpose();
  for (int k = 1; k < edge.count; ++k) {
    const Eigen::Vector2d v = rest_.row(edge.vertex[k]).transpose() - origin;
    g.row(2 * k) << v.x(), v.y();
    g.row(2 * k + 1) << v.y(), -v.x();
  }
  edge.along = rest_.row(edge.vertex[1]).transpose() - origin;
  Eigen::Matrix<double, 2, 8> to_fit = (g.transpose() * g).inverse() * g.transpose();
  // The places are taken relative to the edge's first end.
  for (int k = 1; k < edge.count; ++k) {
    to_fit.col(0) -= to_fit.col(2 * k);
    to_fit.col(1) -= to_fit.col(2 * k + 1);
  }
  edge.fit = to_fit;
}

void Arap::place_pins(std::span<const uint32_t> triangles, std::span<const Vec2> handles) {
  for (const Vec2 handle : handles) {
    const Eigen::Vector2d h = point(handle);
    Eigen::Index nearest = 0;
    (rest_.rowwise() - h.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    Pin pin{{static_cast<int>(nearest), 0, 0}, {1, 0, 0}};
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const int v[3] = {static_cast<int>(triangles[t]), static_cast<int>(triangles[t + 1]),
                        static_cast<int>(triangles[t + 2])};
      const Eigen::Vector2d a = rest_.row(v[0]), b = rest_.row(v[1]), c = rest_.row(v[2]);
      const double whole = cross2(b - a, c - a);
      const double s[3] = {cross2(b - h, c - h) / whole, cross2(c - h, a - h) / whole, cross2(a - h, b - h) / whole};
      if (std::min({s[0], s[1], s[2]}) < 0) continue;
      pin = {{v[0], v[1], v[2]}, {s[0], s[1], s[2]}};
      break;
    }
    pins_.push_back(pin);
  }
}

void Arap::factorise() {
  using Triplet = Eigen::Triplet<double>;
  std::vector<Triplet> first, second;
  const int edges = static_cast<int>(edges_.size()), pins = static_cast<int>(pins_.size());
  for (int e = 0; e < edges; ++e) {
    const Edge& edge = edges_[static_cast<std::size_t>(e)];
    Eigen::Matrix2d along;
    along << edge.along.x(), edge.along.y(), edge.along.y(), -edge.along.x();
    Eigen::Matrix<double, 2, 8> h = -along * edge.fit;
    h(0, 0) -= 1, h(1, 1) -= 1, h(0, 2) += 1, h(1, 3) += 1;
    for (int k = 0; k < edge.count; ++k) {
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 2; ++c) first.emplace_back(2 * e + r, 2 * edge.vertex[k] + c, h(r, 2 * k + c));
      }
    }
    second.emplace_back(e, edge.vertex[0], -1);
    second.emplace_back(e, edge.vertex[1], 1);
  }
  for (int i = 0; i < pins; ++i) {
    const Pin& pin = pins_[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) {
      if (pin.share[k] == 0) continue;
      for (int c = 0; c < 2; ++c)
        first.emplace_back(2 * (edges + i) + c, 2 * pin.vertex[k] + c, kPinWeight * pin.share[k]);
      second.emplace_back(edges + i, pin.vertex[k], kPinWeight * pin.share[k]);
    }
  }
  first_.resize(2 * (edges + pins), 2 * rest_.rows());
  second_.resize(edges + pins, rest_.rows());
  first_.setFromTriplets(first.begin(), first.end());
  second_.setFromTriplets(second.begin(), second.end());
  first_factor_.compute(first_.transpose() * first_);
  second_factor_.compute(second_.transpose() * second_);
  if (first_factor_.info() != Eigen::Success || second_factor_.info() != Eigen::Success) {
    throw std::runtime_error("as-rigid-as-possible: the mesh cannot be solved for");
  }
}

Eigen::Matrix2d Arap::rotation(const Edge& edge, const Eigen::MatrixX2d& at) const {
  Eigen::Matrix<double, 8, 1> places = Eigen::Matrix<double, 8, 1>::Zero();
  for (int k = 0; k < edge.count; ++k) places.segment<2>(2 * k) = at.row(edge.vertex[k]).transpose();
  const Eigen::Vector2d cs = (edge.fit * places).normalized();
  Eigen::Matrix2d r;
  r << cs.x(), cs.y(), -cs.y(), cs.x();
  return r;
}

void Arap::deform(std::span<const Vec2> handles, int rounds, std::span<Vec2> out) {
  const auto edges = static_cast<Eigen::Index>(edges_.size());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(first_.rows());
  Eigen::MatrixX2d b2(second_.rows(), 2);
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const auto row = edges + static_cast<Eigen::Index>(i);
    b.segment<2>(2 * row) = kPinWeight * point(handles[i]);
    b2.row(row) = kPinWeight * point(handles[i]).transpose();
  }
  const Eigen::VectorXd similar = first_factor_.solve(first_.transpose() * b);
  Eigen::MatrixX2d at(rest_.rows(), 2);
  for (Eigen::Index v = 0; v < rest_.rows(); ++v) at.row(v) = similar.segment<2>(2 * v).transpose();
  for (int round = 0; round < rounds; ++round) {
    for (Eigen::Index e = 0; e < edges; ++e) {
      const Edge& edge = edges_[static_cast<std::size_t>(e)];
      b2.row(e) = (rotation(edge, at) * edge.along).transpose();
    }
    at = second_factor_.solve(second_.transpose() * b2);
  }
  for (std::size_t v = 0; v < out.size(); ++v) {
    const auto row = at.row(static_cast<Eigen::Index>(v));
    out[v] = {static_cast<float>(row.x()), static_cast<float>(row.y())};
  }
}

}  // namespace nt::test
