// SPDX-License-Identifier: Apache-2.0
// As-rigid-as-possible deformation in the plane, as Meta's AnimatedDrawings does it: Igarashi, Moscovich, Hughes,
// "As-rigid-as-possible shape manipulation", 2005, in the edge form of Igarashi and Igarashi, "Implementing
// as-rigid-as-possible shape manipulation and surface flattening", 2009. The peer that bench_deform measures ours against.
//
// Rest mesh + handles anywhere in it, each frame the handles' places -> vertices. A handle holds the triangle it lies in
// (barycentric, weight 1000); one outside the mesh is held at the nearest vertex. Step 1 solves for a mesh that is similar
// near each edge, step 2 takes the scale out. `rounds` > 1 repeats step 2 with the rotations of the last result (local
// and global steps in turn, Sorkine and Alexa 2007). Eigen, double, factors kept.
#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "core/base/vec2.h"

namespace nt::test {

class Arap {
 public:
  Arap(std::span<const Vec2> vertices, std::span<const uint32_t> triangles, std::span<const Vec2> handles);
  void deform(std::span<const Vec2> handles, int rounds, std::span<Vec2> out);

 private:
  struct Edge {
    int vertex[4];  // its ends, then the corners opposite to it
    int count = 3;  // 3 at the rim, 4 inside
    Eigen::Vector2d along = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, 8> fit =
        Eigen::Matrix<double, 2, 8>::Zero();  // the neighbours' places -> (c, s) of the similarity nearest to them
  };
  struct Pin {
    int vertex[3];
    double share[3];
  };
  void find_edges(std::span<const uint32_t> triangles);
  void fit_edge(Edge& edge) const;
  void place_pins(std::span<const uint32_t> triangles, std::span<const Vec2> handles);
  void factorise();
  Eigen::Matrix2d rotation(const Edge& edge, const Eigen::MatrixX2d& at) const;

  Eigen::MatrixX2d rest_;
  std::vector<Edge> edges_;
  std::vector<Pin> pins_;
  Eigen::SparseMatrix<double> first_, second_;  // the two least-squares systems' matrices
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> first_factor_, second_factor_;
};

}  // namespace nt::test
