// SPDX-License-Identifier: Apache-2.0
#include "app/author/lattice_binding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nt {
namespace {

float mean_edge(std::span<const Vec3> x, std::span<const uint16_t> tetrahedra) {
  double sum = 0.0;
  for (std::size_t t = 0; t < tetrahedra.size(); t += 4) {
    for (std::size_t k = 1; k < 4; ++k) {
      sum += static_cast<double>(length(x[tetrahedra[t + k]] - x[tetrahedra[t + k - 1]]));
    }
  }
  return std::max(static_cast<float>(sum / (0.75 * static_cast<double>(tetrahedra.size()))), 1e-9f);
}

}  // namespace

std::array<float, 4> barycentric(const std::array<Vec3, 4>& c, Vec3 p) {
  const float whole = volume6(c[0], c[1], c[2], c[3]);
  if (whole == 0.0f) return {};
  const float a = volume6(p, c[1], c[2], c[3]) / whole, b = volume6(c[0], p, c[2], c[3]) / whole,
              d = volume6(c[0], c[1], p, c[3]) / whole;
  return {a, b, d, 1.0f - a - b - d};
}

float least_weight(const std::array<Vec3, 4>& corner, Vec3 p) {
  const auto w = barycentric(corner, p);
  return *std::min_element(w.begin(), w.end());
}

Binder::Binder(std::span<const Vec3> vertices, std::span<const uint16_t> tetrahedra, float spacing)
    : vertices_(vertices), tetrahedra_(tetrahedra), bin_(spacing > 0.0f ? spacing : mean_edge(vertices, tetrahedra)) {
  Vec3 high = vertices[0];
  low_ = high;
  for (const Vec3 p : vertices) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  size_ = {static_cast<int>((high.x - low_.x) / bin_) + 1, static_cast<int>((high.y - low_.y) / bin_) + 1,
           static_cast<int>((high.z - low_.z) / bin_) + 1};
  bins_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
               static_cast<std::size_t>(size_[2]));
  for (std::size_t t = 0; t < tetrahedra.size() / 4; ++t) {
    std::array<int, 3> from = bin_of(vertices[tetrahedra[4 * t]]), to = from;
    for (const Vec3 p : corners(t)) {
      const auto b = bin_of(p);
      for (std::size_t a = 0; a < 3; ++a) from[a] = std::min(from[a], b[a]), to[a] = std::max(to[a], b[a]);
    }
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        for (int x = from[0]; x <= to[0]; ++x) {
          bins_[static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x)].push_back(static_cast<uint16_t>(t));
        }
      }
    }
  }
}

std::array<int, 3> Binder::bin_of(Vec3 p) const {
  const Vec3 d = p - low_;
  const float at[3] = {d.x, d.y, d.z};
  std::array<int, 3> out{};
  for (std::size_t a = 0; a < 3; ++a) {
    out[a] = static_cast<int>(std::clamp(std::floor(at[a] / bin_), 0.0f, static_cast<float>(size_[a] - 1)));
  }
  return out;
}

std::array<Vec3, 4> Binder::corners(std::size_t t) const {
  const uint16_t* v = &tetrahedra_[4 * t];
  return {vertices_[v[0]], vertices_[v[1]], vertices_[v[2]], vertices_[v[3]]};
}

// Rings of bins around p, one further than the first in which there is anything.
Binding Binder::bind(Vec3 p) const {
  const auto centre = bin_of(p);
  Binding best;
  float most = -std::numeric_limits<float>::infinity();
  int last = std::max({size_[0], size_[1], size_[2]});
  for (int ring = 0; ring <= last; ++ring) {
    for (int z = std::max(0, centre[2] - ring); z <= std::min(size_[2] - 1, centre[2] + ring); ++z) {
      for (int y = std::max(0, centre[1] - ring); y <= std::min(size_[1] - 1, centre[1] + ring); ++y) {
        for (int x = std::max(0, centre[0] - ring); x <= std::min(size_[0] - 1, centre[0] + ring); ++x) {
          if (std::max({std::abs(x - centre[0]), std::abs(y - centre[1]), std::abs(z - centre[2])}) != ring) continue;
          for (const uint16_t t : bins_[static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x)]) {
            const auto w = barycentric(corners(t), p);
            const float least = *std::min_element(w.begin(), w.end());
            if (least > most) most = least, best = {t, w};
          }
        }
      }
    }
    if (most >= 0.0f) break;
    if (most > -std::numeric_limits<float>::infinity()) last = std::min(last, ring + 1);
  }
  return best;
}

MarkerBinding Binder::marker(Vec3 p) const {
  const Binding b = bind(p);
  MarkerBinding out;
  for (std::size_t k = 0; k < 4; ++k) {
    out.vertex[k] = tetrahedra_[4u * b.tetrahedron + k];
    out.weight[k] = b.weight[k];
  }
  return out;
}

EmbeddingData embed_mesh(const std::vector<Vec3>& points, const Binder& binder, int& outside) {
  std::vector<Binding> bindings;
  for (const Vec3 p : points) {
    bindings.push_back(binder.bind(p));
    outside += *std::min_element(bindings.back().weight.begin(), bindings.back().weight.end()) < -1e-3f;
  }
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return bindings[a].tetrahedron < bindings[b].tetrahedron; });
  EmbeddingData out;
  out.slot.resize(points.size());
  for (std::size_t k = 0; k < order.size();) {
    const uint16_t tet = bindings[order[k]].tetrahedron;
    out.tetrahedron.push_back(tet);
    float block[12];
    uint32_t v = order[k];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (k < order.size() && bindings[order[k]].tetrahedron == tet) {
        v = order[k++];
        out.slot[v] = static_cast<uint32_t>(out.source.size());
      }
      for (std::size_t c = 0; c < 3; ++c) block[4 * c + lane] = bindings[v].weight[c + 1];
      out.source.push_back(v);
    }
    out.coordinates.insert(out.coordinates.end(), block, block + 12);
  }
  return out;
}

}  // namespace nt
