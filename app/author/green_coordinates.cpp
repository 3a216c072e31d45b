// SPDX-License-Identifier: Apache-2.0
#include "app/author/green_coordinates.h"

#include <algorithm>
#include <cmath>

#include "app/author/lattice_binding.h"

namespace nt {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct D3 {
  double x = 0, y = 0, z = 0;
};
D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
D3 operator-(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
D3 operator*(double s, D3 a) { return {s * a.x, s * a.y, s * a.z}; }
double dot3(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
D3 cross3(D3 a, D3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double norm(D3 a) { return std::sqrt(dot3(a, a)); }
D3 wide(Vec3 p) { return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}; }
double sign(double v) { return (v > 0) - (v < 0); }
double angle(D3 a, D3 b) { return std::acos(std::clamp(dot3(a, b) / (norm(a) * norm(b)), -1.0, 1.0)); }

// GCTriInt of the paper's Algorithm 1.
double triangle_integral(D3 p, D3 v1, D3 v2, D3 eta) {
  const double alpha = angle(v2 - v1, p - v1), beta = angle(v1 - p, v2 - p);
  const double lambda = dot3(p - v1, p - v1) * std::sin(alpha) * std::sin(alpha), c = dot3(p - eta, p - eta);
  const auto at = [&](double theta) {
    const double s = std::sin(theta), k = std::cos(theta), root = std::sqrt(c);
    const double round = 2 * root * std::atan(root * k / std::sqrt(lambda + s * s * c));
    const double inner = 1 - 2 * c * k / (c * (1 + k) + lambda + std::sqrt(lambda * lambda + lambda * c * s * s));
    const double log = std::log(2 * std::sqrt(lambda) * s * s / ((1 - k) * (1 - k)) * inner);
    return -0.5 * sign(s) * (round + std::sqrt(lambda) * log);
  };
  const double value = at(kPi - alpha) - at(kPi - alpha - beta) - std::sqrt(c) * beta;
  return std::isfinite(value) ? -std::abs(value) / (4 * kPi) : 0.0;
}

// Adds one face's share; the corners are relative to the point.
void add_face(const std::array<D3, 4>& v, std::size_t face, std::array<double, 8>& out) {
  const auto& f = kFaces[face];
  const std::array<D3, 3> x = {v[f[0]], v[f[1]], v[f[2]]};
  D3 n = cross3(x[1] - x[0], x[2] - x[0]);
  n = (1 / norm(n)) * n;
  const D3 p = dot3(x[0], n) * n;
  double own = 0, edge[3];
  D3 side[3];
  for (std::size_t l = 0; l < 3; ++l) {
    const D3 a = x[l], b = x[(l + 1) % 3];
    own += sign(dot3(cross3(a - p, b - p), n)) * triangle_integral(p, a, b, {});
    edge[l] = triangle_integral({}, b, a, {});
    side[l] = cross3(b, a);
    side[l] = (1 / norm(side[l])) * side[l];
  }
  own = -std::abs(own);
  out[4 + face] = -own;
  D3 w = own * n;
  for (std::size_t l = 0; l < 3; ++l) w = w + edge[l] * side[l];
  if (norm(w) < 1e-12) return;
  for (std::size_t l = 0; l < 3; ++l) {
    const D3 next = side[(l + 1) % 3];
    const double along = dot3(next, x[l]);
    if (std::abs(along) > 1e-14) out[f[l]] += dot3(next, w) / along;
  }
}

}  // namespace

std::array<double, 8> green_coordinates(const std::array<Vec3, 4>& corners, Vec3 p) {
  constexpr float kInside = 0.004f;  // least barycentric weight of a point that is taken as it is
  const auto weight = barycentric(corners, p);
  std::array<float, 4> inside{};
  float sum = 0.0f;
  for (std::size_t k = 0; k < 4; ++k) sum += inside[k] = std::max(weight[k], kInside);
  Vec3 at;
  for (std::size_t k = 0; k < 4; ++k) inside[k] /= sum, at += inside[k] * corners[k];
  // In units of the tetrahedron, so that the formulas' small numbers are small.
  const float size = std::max(length(corners[1] - corners[0]), 1e-20f);
  std::array<D3, 4> v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = wide((1.0f / size) * (corners[k] - at));
  std::array<double, 8> out{};
  for (std::size_t face = 0; face < 4; ++face) add_face(v, face, out);
  for (std::size_t k = 0; k < 4; ++k) {
    out[k] += static_cast<double>(weight[k] - inside[k]);
    out[4 + k] *= static_cast<double>(size);
  }
  return out;
}

std::vector<float> green_embedding(const EmbeddingView& e, const LatticeView& lattice) {
  std::vector<float> out;
  for (std::size_t k = 0; k < e.blocks(); ++k) {
    const uint16_t* t = &lattice.tetrahedra[4u * e.tetrahedron[k]];
    const std::array<Vec3, 4> corners = {lattice.vertices[t[0]], lattice.vertices[t[1]], lattice.vertices[t[2]],
                                         lattice.vertices[t[3]]};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const float* b = &e.coordinates[12 * k + lane];
      const Vec3 p =
          (1.0f - b[0] - b[4] - b[8]) * corners[0] + b[0] * corners[1] + b[4] * corners[2] + b[8] * corners[3];
      for (const double c : green_coordinates(corners, p)) out.push_back(static_cast<float>(c));
    }
  }
  return out;
}

}  // namespace nt
