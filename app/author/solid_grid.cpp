// SPDX-License-Identifier: Apache-2.0
#include "app/author/solid_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nt {
namespace {

float part(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

bool usable(Vec3 p) {
  constexpr float kFar = 1e6f;
  return std::abs(p.x) <= kFar && std::abs(p.y) <= kFar && std::abs(p.z) <= kFar;
}

// Where a ray through the centre of a column passes the mesh.
struct Crossing {
  float depth;
  int sign;
};

// The lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012), one line of a distance transform.
void transform_line(std::vector<float>& f, std::vector<int>& v, std::vector<float>& z, std::vector<float>& out, int n) {
  constexpr float kFar = 1e18f;
  int k = -1;
  for (int q = 0; q < n; ++q) {
    if (f[static_cast<std::size_t>(q)] >= kFar) continue;
    float s = -kFar;
    while (k >= 0) {
      const int p = v[static_cast<std::size_t>(k)];
      s = ((f[static_cast<std::size_t>(q)] + static_cast<float>(q * q)) -
           (f[static_cast<std::size_t>(p)] + static_cast<float>(p * p))) /
          static_cast<float>(2 * (q - p));
      if (s > z[static_cast<std::size_t>(k)]) break;
      --k;
    }
    ++k;
    v[static_cast<std::size_t>(k)] = q;
    z[static_cast<std::size_t>(k)] = k == 0 ? -kFar : s;
  }
  if (k < 0) {
    std::fill(out.begin(), out.begin() + n, kFar);
    return;
  }
  const int last = k;
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (k < last && z[static_cast<std::size_t>(k + 1)] < static_cast<float>(q)) ++k;
    const int p = v[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(q)] = static_cast<float>((q - p) * (q - p)) + f[static_cast<std::size_t>(p)];
  }
}

}  // namespace

TriangleMesh cleaned(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.positions = mesh.positions;
  for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    const uint32_t* i = &mesh.triangles[t];
    if (std::max({i[0], i[1], i[2]}) >= mesh.positions.size()) continue;
    const Vec3 a = mesh.positions[i[0]], b = mesh.positions[i[1]], c = mesh.positions[i[2]];
    if (!usable(a) || !usable(b) || !usable(c)) continue;
    // Not by their product, which vanishes for a small mesh.
    if (!(length(b - a) > 1e-12f && length(c - a) > 1e-12f && length(c - b) > 1e-12f)) continue;
    out.triangles.insert(out.triangles.end(), i, i + 3);
  }
  for (Vec3& p : out.positions) {
    if (!usable(p)) p = {};
  }
  return out;
}

SolidGrid::SolidGrid(const TriangleMesh& mesh, int cells_along_longest, int margin) {
  Vec3 low = mesh.positions[mesh.triangles[0]], high = low;
  for (const uint32_t i : mesh.triangles) {
    const Vec3 p = mesh.positions[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  cell_ = std::max({extent.x, extent.y, extent.z}) / static_cast<float>(cells_along_longest);
  origin_ = low - Vec3{1, 1, 1} * (static_cast<float>(margin) * cell_);
  for (int a = 0; a < 3; ++a) {
    size_[static_cast<std::size_t>(a)] = static_cast<int>(part(extent, a) / cell_) + 1 + 2 * margin;
  }
  const std::size_t cells = at(size_[0] - 1, size_[1] - 1, size_[2] - 1) + 1;
  std::vector<uint8_t> votes(cells);
  for (int axis = 0; axis < 3; ++axis) vote(mesh, axis, votes);
  for (uint8_t& v : votes) v = v >= 4;
  close(votes);
  solid_ = std::move(votes);
  mark_surface(mesh);
  measure_distances();
}

void SolidGrid::vote(const TriangleMesh& mesh, int axis, std::vector<uint8_t>& votes) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3, across = size(u);
  std::vector<std::vector<Crossing>> columns(static_cast<std::size_t>(across) * static_cast<std::size_t>(size(v)));
  const auto grid = [&](Vec3 p, int a) { return (part(p, a) - part(origin_, a)) / cell_ - 0.5f; };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    float cu[3], cv[3], cd[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.positions[mesh.triangles[t + k]];
      cu[k] = grid(p, u), cv[k] = grid(p, v), cd[k] = grid(p, axis);
    }
    const float area = (cu[1] - cu[0]) * (cv[2] - cv[0]) - (cu[2] - cu[0]) * (cv[1] - cv[0]);
    if (area == 0.0f) continue;
    const int u0 = static_cast<int>(std::ceil(std::min({cu[0], cu[1], cu[2]}))),
              u1 = static_cast<int>(std::max({cu[0], cu[1], cu[2]}));
    const int v0 = static_cast<int>(std::ceil(std::min({cv[0], cv[1], cv[2]}))),
              v1 = static_cast<int>(std::max({cv[0], cv[1], cv[2]}));
    for (int j = v0; j <= v1; ++j) {
      for (int i = u0; i <= u1; ++i) {
        // A hair off the centre, so that rays do not run along edges of meshes on a grid.
        const float x = static_cast<float>(i) + 1.37e-3f, y = static_cast<float>(j) + 2.71e-3f;
        float w[3];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
          w[k] = ((cu[b] - cu[a]) * (y - cv[a]) - (cv[b] - cv[a]) * (x - cu[a])) / area;
        }
        if (w[0] < 0.0f || w[1] < 0.0f || w[2] < 0.0f) continue;
        columns[static_cast<std::size_t>(j) * static_cast<std::size_t>(across) + static_cast<std::size_t>(i)].push_back(
            {w[0] * cd[0] + w[1] * cd[1] + w[2] * cd[2], area > 0.0f ? 1 : -1});
      }
    }
  }
  for (int j = 0; j < size(v); ++j) {
    for (int i = 0; i < across; ++i) {
      auto& column =
          columns[static_cast<std::size_t>(j) * static_cast<std::size_t>(across) + static_cast<std::size_t>(i)];
      if (column.empty()) continue;
      std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.depth < b.depth; });
      int total = 0;
      for (const Crossing& c : column) total += c.sign;
      int before = 0;
      std::size_t next = 0;
      for (int d = 0; d < size(axis); ++d) {
        while (next < column.size() && column[next].depth < static_cast<float>(d)) before += column[next++].sign;
        int at3[3];
        at3[axis] = d, at3[u] = i, at3[v] = j;
        votes[at(at3[0], at3[1], at3[2])] =
            static_cast<uint8_t>(votes[at(at3[0], at3[1], at3[2])] + (before != 0) + (total - before != 0));
      }
    }
  }
}

// Dilation then erosion by the six neighbours.
void SolidGrid::close(std::vector<uint8_t>& inside) const {
  for (const uint8_t grow : {uint8_t{1}, uint8_t{0}}) {
    const std::vector<uint8_t> before = inside;
    for (int z = 1; z + 1 < size_[2]; ++z) {
      for (int y = 1; y + 1 < size_[1]; ++y) {
        for (int x = 1; x + 1 < size_[0]; ++x) {
          const auto is = [&](int dx, int dy, int dz) { return before[at(x + dx, y + dy, z + dz)] == grow; };
          if (is(1, 0, 0) || is(-1, 0, 0) || is(0, 1, 0) || is(0, -1, 0) || is(0, 0, 1) || is(0, 0, -1)) {
            inside[at(x, y, z)] = grow;
          }
        }
      }
    }
  }
}

// Points of each triangle half a cell apart; a triangle spans at most the grid, so this is bounded by its area in cells.
void SolidGrid::mark_surface(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const Vec3 a = mesh.positions[mesh.triangles[t]], b = mesh.positions[mesh.triangles[t + 1]],
               c = mesh.positions[mesh.triangles[t + 2]];
    const float longest = std::max({length(b - a), length(c - a), length(c - b)});
    const int steps = static_cast<int>(longest / (0.5f * cell_)) + 1;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const float s = static_cast<float>(i) / static_cast<float>(steps),
                    r = static_cast<float>(j) / static_cast<float>(steps);
        const auto cell = cell_of(a + s * (b - a) + r * (c - a));
        solid_[at(cell[0], cell[1], cell[2])] = 1;
      }
    }
  }
}

std::array<int, 3> SolidGrid::cell_of(Vec3 p) const {
  std::array<int, 3> out{};
  for (int a = 0; a < 3; ++a) {
    const float c = std::floor((part(p, a) - part(origin_, a)) / cell_);
    out[static_cast<std::size_t>(a)] = static_cast<int>(std::clamp(c, 0.0f, static_cast<float>(size(a) - 1)));
  }
  return out;
}

void SolidGrid::measure_distances() {
  squared_.resize(solid_.size());
  for (std::size_t i = 0; i < solid_.size(); ++i) squared_[i] = solid_[i] ? 0.0f : 1e18f;
  const auto longest = static_cast<std::size_t>(std::max({size_[0], size_[1], size_[2]}));
  std::vector<float> line(longest), out(longest), z(longest + 1);
  std::vector<int> v(longest);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    for (int j = 0; j < size(w); ++j) {
      for (int i = 0; i < size(u); ++i) {
        int c[3];
        c[u] = i, c[w] = j;
        for (int d = 0; d < size(axis); ++d)
          c[axis] = d, line[static_cast<std::size_t>(d)] = squared_[at(c[0], c[1], c[2])];
        transform_line(line, v, z, out, size(axis));
        for (int d = 0; d < size(axis); ++d)
          c[axis] = d, squared_[at(c[0], c[1], c[2])] = out[static_cast<std::size_t>(d)];
      }
    }
  }
}

float SolidGrid::distance(Vec3 p) const {
  const auto c = cell_of(p);
  const float outside = length(p - centre(c[0], c[1], c[2]));
  const float inside = std::sqrt(squared_[at(c[0], c[1], c[2])]) * cell_;
  return outside > cell_ ? outside + inside : inside;
}

double SolidGrid::volume() const {
  double sum = 0.0;
  for (const uint8_t s : solid_) sum += s;
  return sum * cell_ * cell_ * cell_;
}

}  // namespace nt
