// SPDX-License-Identifier: Apache-2.0
#include "app/author/triangulate.h"

// Qhull's C interface: its C++ headers are not valid C++20.
#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "core/base/random.h"

namespace nt {
namespace {

// Outline samples lie closer than the grid's points, which keep this many grid steps away from the outline: the circle
// over an outline edge (radius 0.3 steps) then holds no grid point.
constexpr float kOutlineStep = 0.6f;
constexpr float kKeepAway = 0.6f;
constexpr float kJitter = 0.12f;  // breaks the ties of a regular grid; in grid steps
constexpr int kRepairs = 10;      // halvings: from 6 px to far under a pixel
constexpr int kSizings = 6;
constexpr float kLeastStep = 1.0f;  // finer than the outline's own pixels is noise; also bounds the work

using Edge = std::pair<uint32_t, uint32_t>;
Edge edge(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

double area2(Vec2 a, Vec2 b, Vec2 c) {
  return (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
         (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x);
}

double polygon_area2(std::span<const Vec2> p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], b = p[(i + 1) % p.size()];
    sum += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
  }
  return sum;
}

// A point of the outline by arc length.
class Outline {
 public:
  explicit Outline(std::span<const Vec2> points) : points_(points.begin(), points.end()) {
    smooth();
    at_.push_back(0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      at_.push_back(at_.back() + static_cast<double>(length(points_[(i + 1) % points_.size()] - points_[i])));
    }
  }
  double perimeter() const { return at_.back(); }
  Vec2 at(double s) const {
    const auto it = std::upper_bound(at_.begin(), at_.end() - 1, s);
    const auto i = static_cast<std::size_t>(it - at_.begin()) - 1;
    const double len = at_[i + 1] - at_[i];
    const double t = len > 0 ? (s - at_[i]) / len : 0;
    return lerp(points_[i], points_[(i + 1) % points_.size()], static_cast<float>(t));
  }

 private:
  // Pixel stairs go: twice a [1 2 1] / 4 average.
  void smooth() {
    for (int pass = 0; pass < 2; ++pass) {
      const std::vector<Vec2> p = points_;
      const std::size_t n = p.size();
      for (std::size_t i = 0; i < n; ++i) points_[i] = p[i] * 0.5f + (p[(i + n - 1) % n] + p[(i + 1) % n]) * 0.25f;
    }
  }
  std::vector<Vec2> points_;
  std::vector<double> at_;
};

std::vector<cv::Point2f> to_cv(std::span<const Vec2> points) {
  std::vector<cv::Point2f> out;
  for (const Vec2 p : points) out.emplace_back(p.x, p.y);
  return out;
}

std::vector<Vec2> grid_inside(const std::vector<cv::Point2f>& polygon, float step) {
  Random random(1);
  const cv::Rect box = cv::boundingRect(polygon);
  const float row_step = step * 0.8660254f;
  const int rows = static_cast<int>(static_cast<float>(box.height) / row_step) + 1;
  const int columns = static_cast<int>(static_cast<float>(box.width) / step) + 1;
  std::vector<Vec2> out;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const float jx = (random.unit() - 0.5f) * 2 * kJitter * step, jy = (random.unit() - 0.5f) * 2 * kJitter * step;
      const float shift = r % 2 == 0 ? 0.25f : 0.75f;
      const Vec2 p{static_cast<float>(box.x) + (static_cast<float>(c) + shift) * step + jx,
                   static_cast<float>(box.y) + (static_cast<float>(r) + 0.5f) * row_step + jy};
      if (cv::pointPolygonTest(polygon, {p.x, p.y}, true) >= static_cast<double>(kKeepAway * step)) out.push_back(p);
    }
  }
  return out;
}

// Qhull's state, freed on every way out.
struct QhullState {
  qhT state;
  QhullState() { qh_zero(&state, nullptr); }
  ~QhullState() {
    qh_freeqhull(&state, !qh_ALL);
    int short_bytes = 0, blocks = 0;
    qh_memfreeshort(&state, &short_bytes, &blocks);
  }
  QhullState(const QhullState&) = delete;
  QhullState& operator=(const QhullState&) = delete;
};

std::vector<std::array<uint32_t, 3>> delaunay(const std::vector<Vec2>& points) {
  std::vector<coordT> flat;
  for (const Vec2 p : points) flat.insert(flat.end(), {static_cast<double>(p.x), static_cast<double>(p.y)});
  QhullState q;
  qhT* qh = &q.state;
  // Qt: only triangles; Qbb, Qc, Qz: precision for points on a grid, coplanar ones kept, a point at infinity.
  char command[] = "qhull d Qt Qbb Qc Qz";
  const int failed =
      qh_new_qhull(qh, 2, static_cast<int>(points.size()), flat.data(), False, command, nullptr, nullptr);
  if (failed != 0) throw TriangulationError("the figure's outline cannot be cut into triangles");
  std::vector<std::array<uint32_t, 3>> out;
  facetT* facet = nullptr;
  FORALLfacets {
    if (facet->upperdelaunay) continue;
    std::array<uint32_t, 3> t{};
    std::size_t i = 0;
    vertexT* vertex = nullptr;
    vertexT** vertexp = nullptr;
    FOREACHvertex_(facet->vertices) {
      if (i < 3) t[i++] = static_cast<uint32_t>(qh_pointid(qh, vertex->point));
    }
    if (i == 3 && std::max({t[0], t[1], t[2]}) < points.size()) out.push_back(t);
  }
  return out;
}

// Keeps what lies inside, turned to positive area.
std::vector<uint32_t> inside(const std::vector<std::array<uint32_t, 3>>& all, const std::vector<Vec2>& v,
                             const std::vector<cv::Point2f>& polygon) {
  std::vector<uint32_t> out;
  for (std::array<uint32_t, 3> t : all) {
    const Vec2 a = v[t[0]], b = v[t[1]], c = v[t[2]];
    const double area = area2(a, b, c);
    if (std::abs(area) < 1e-6) continue;  // what Qt makes of four points on one circle
    if (area < 0) std::swap(t[1], t[2]);
    const Vec2 centroid = (a + b + c) * (1.0f / 3.0f);
    if (cv::pointPolygonTest(polygon, {centroid.x, centroid.y}, false) >= 0) out.insert(out.end(), t.begin(), t.end());
  }
  return out;
}

std::vector<std::size_t> missing_edges(const std::vector<uint32_t>& triangles, std::size_t outline_count) {
  std::set<Edge> present;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) present.insert(edge(triangles[i + k], triangles[i + (k + 1) % 3]));
  }
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < outline_count; ++i) {
    const auto next = static_cast<uint32_t>((i + 1) % outline_count);
    if (!present.contains(edge(static_cast<uint32_t>(i), next))) missing.push_back(i);
  }
  return missing;
}

// Places along the outline, each edge in `where` halved.
std::vector<double> halved(const std::vector<double>& s, const std::vector<std::size_t>& where, double perimeter) {
  std::vector<double> out;
  std::size_t k = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    out.push_back(s[i]);
    if (k < where.size() && where[k] == i) {
      const double next = i + 1 < s.size() ? s[i + 1] : perimeter;
      out.push_back(0.5 * (s[i] + next));
      ++k;
    }
  }
  return out;
}

Triangulation triangulate_at(const Outline& outline, float step) {
  const int count =
      std::max(16, static_cast<int>(std::lround(outline.perimeter() / static_cast<double>(kOutlineStep * step))));
  std::vector<double> s;
  for (int i = 0; i < count; ++i) s.push_back(outline.perimeter() * i / count);
  for (int repair = 0; repair <= kRepairs; ++repair) {
    Triangulation t;
    for (const double at : s) t.vertices.push_back(outline.at(at));
    t.outline_count = t.vertices.size();
    const std::vector<cv::Point2f> polygon = to_cv(t.vertices);
    const std::vector<Vec2> grid = grid_inside(polygon, step);
    t.vertices.insert(t.vertices.end(), grid.begin(), grid.end());
    t.triangles = inside(delaunay(t.vertices), t.vertices, polygon);
    const std::vector<std::size_t> missing = missing_edges(t.triangles, t.outline_count);
    if (missing.empty()) return t;
    s = halved(s, missing, outline.perimeter());
    if (s.size() > 3 * static_cast<std::size_t>(count)) break;  // halving does not help: the edges cross
  }
  throw TriangulationError("the figure's outline touches or crosses itself");
}

// With every outline edge there, the triangles fill the outline exactly.
void check_filled(const Triangulation& t) {
  double sum = 0;
  for (std::size_t i = 0; i < t.triangles.size(); i += 3) {
    sum += area2(t.vertices[t.triangles[i]], t.vertices[t.triangles[i + 1]], t.vertices[t.triangles[i + 2]]);
  }
  const double whole = std::abs(polygon_area2(std::span(t.vertices).first(t.outline_count)));
  if (std::abs(sum - whole) > 1e-3 * whole) throw TriangulationError("the figure's outline crosses itself");
}

}  // namespace

Triangulation triangulate(std::span<const Vec2> points, int vertices_wanted) {
  const Outline outline(points);
  const double area = std::abs(polygon_area2(points)) * 0.5;
  // Thinner than 2 px on average, or halves that cancel out.
  if (area < outline.perimeter()) throw TriangulationError("the figure's outline touches or crosses itself");
  float step = std::max(kLeastStep, static_cast<float>(std::sqrt(area / (0.866 * std::max(vertices_wanted, 16)))));
  Triangulation t;
  for (int i = 0; i < kSizings; ++i) {
    t = triangulate_at(outline, step);
    const double ratio = static_cast<double>(t.vertices.size()) / vertices_wanted;
    if (ratio > 0.95 && ratio < 1.05) break;
    step = std::max(kLeastStep, step * static_cast<float>(std::sqrt(ratio)));
  }
  check_filled(t);
  return t;
}

}  // namespace nt
