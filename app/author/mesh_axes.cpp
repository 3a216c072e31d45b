// SPDX-License-Identifier: Apache-2.0
#include "app/author/mesh_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "platform/camera.h"

namespace nt {
namespace {

constexpr float kSnap = 0.966f;      // cosine of 15 degrees
constexpr double kMoreAlike = 0.06;  // of symmetry between two axes: less does not tell
constexpr int kVoxels = 32;          // along the longest side, for symmetry

float dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross3(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3 minus(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 scaled3(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
Vec3 unit3(Vec3 a) { return scaled3(a, 1 / std::max(std::sqrt(dot3(a, a)), 1e-30f)); }
// The part of a across b.
Vec3 across(Vec3 a, Vec3 b) { return minus(a, scaled3(b, dot3(a, b))); }

constexpr std::array<Vec3, 3> kFileAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Vec3 snapped(Vec3 v) {
  for (const Vec3 axis : kFileAxes) {
    if (std::abs(dot3(v, axis)) > kSnap) return dot3(v, axis) > 0 ? axis : scaled3(axis, -1);
  }
  return v;
}

Vec3 centroid(std::span<const SoupCorner> c, std::size_t t) {
  const Vec3 a = c[3 * t].position, b = c[3 * t + 1].position, d = c[3 * t + 2].position;
  return {(a.x + b.x + d.x) / 3, (a.y + b.y + d.y) / 3, (a.z + b.z + d.z) / 3};
}

struct Pca {
  Vec3 mean;
  std::array<Vec3, 3> axes;  // longest first
};

Pca principal(std::span<const SoupCorner> c) {
  cv::Matx33d sum = cv::Matx33d::zeros();
  cv::Vec3d mean(0, 0, 0);
  double area = 1e-300;
  std::vector<std::pair<cv::Vec3d, double>> parts;
  for (std::size_t t = 0; t < c.size() / 3; ++t) {
    const Vec3 n =
        cross3(minus(c[3 * t + 1].position, c[3 * t].position), minus(c[3 * t + 2].position, c[3 * t].position));
    const double w = std::sqrt(static_cast<double>(dot3(n, n)));
    const Vec3 m = centroid(c, t);
    parts.emplace_back(cv::Vec3d(static_cast<double>(m.x), static_cast<double>(m.y), static_cast<double>(m.z)), w);
    mean += parts.back().first * w, area += w;
  }
  mean *= 1 / area;
  for (const auto& [at, w] : parts) {
    const cv::Vec3d d = at - mean;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum(i, j) += w * d[i] * d[j];
    }
  }
  cv::Mat values, vectors;
  cv::eigen(cv::Mat(sum * (1 / area)), values, vectors);
  Pca out;
  out.mean = {static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])};
  for (int i = 0; i < 3; ++i) {
    out.axes[static_cast<std::size_t>(i)] = {static_cast<float>(vectors.at<double>(i, 0)),
                                             static_cast<float>(vectors.at<double>(i, 1)),
                                             static_cast<float>(vectors.at<double>(i, 2))};
  }
  return out;
}

// The share of filled cells whose mirror image across the plane through `mean` is filled too.
double alikeness(std::span<const SoupCorner> c, Vec3 mean, Vec3 normal, float cell) {
  using Cell = std::array<int, 3>;
  const auto cell_of = [&](Vec3 p) {
    const Vec3 d = minus(p, mean);
    return Cell{static_cast<int>(std::lround(d.x / cell)), static_cast<int>(std::lround(d.y / cell)),
                static_cast<int>(std::lround(d.z / cell))};
  };
  std::set<Cell> filled;
  for (const SoupCorner& k : c) filled.insert(cell_of(k.position));
  int met = 0, all = 0;
  const std::size_t step = std::max<std::size_t>(1, c.size() / 6000);
  for (std::size_t i = 0; i < c.size(); i += step) {
    const Vec3 p = c[i].position;
    const Vec3 image = minus(p, scaled3(normal, 2 * dot3(minus(p, mean), normal)));
    ++all;
    if (filled.contains(cell_of(image))) ++met;
  }
  return all > 0 ? static_cast<double>(met) / all : 0;
}

}  // namespace

Vec3 parse_axis(const std::string& what, const std::string& text) {
  const bool two = text.size() == 2 && (text[0] == '+' || text[0] == '-') && text[1] >= 'x' && text[1] <= 'z';
  if (!two)
    throw UserError(what + " '" + text + "': for a mesh this is an axis of the file: +x, -x, +y, -y, +z or -z", 2);
  return scaled3(kFileAxes[static_cast<std::size_t>(text[1] - 'x')], text[0] == '+' ? 1.0f : -1.0f);
}

MeshAxes find_axes(std::span<const SoupCorner> corners, const ToldAxes& told) {
  const Pca pca = principal(corners);
  MeshAxes out;
  out.head_told = told.head.has_value();
  out.forward = told.head ? *told.head : snapped(pca.axes[0]);
  if (told.up && std::abs(dot3(out.forward, *told.up)) > 0.9f) {
    throw UserError("--up lies along the body; choose another axis, or say where the head is with --head", 2);
  }
  std::array<Vec3, 2> others{unit3(across(snapped(pca.axes[1]), out.forward)), Vec3{}};
  if (std::abs(dot3(pca.axes[1], out.forward)) > 0.7f) others[0] = unit3(across(pca.axes[0], out.forward));
  others[1] = cross3(out.forward, others[0]);
  float size = 0;
  for (const SoupCorner& c : corners)
    size = std::max(size, std::sqrt(dot3(minus(c.position, pca.mean), minus(c.position, pca.mean))));
  const float cell = std::max(2 * size / kVoxels, 1e-20f);
  const double alike[2] = {alikeness(corners, pca.mean, others[0], cell),
                           alikeness(corners, pca.mean, others[1], cell)};
  out.symmetry = std::max(alike[0], alike[1]);
  Vec3 file_up = kFileAxes[1];
  if (std::abs(dot3(out.forward, file_up)) > 0.7f) file_up = kFileAxes[2];  // it stands: laid down, its front is up
  std::size_t up = std::abs(dot3(others[0], file_up)) > std::abs(dot3(others[1], file_up)) ? 0 : 1;
  if (std::abs(alike[0] - alike[1]) > kMoreAlike) up = alike[0] < alike[1] ? 0 : 1;
  out.up = others[up];
  const float with = dot3(out.up, file_up);
  if (std::abs(with) > 0.3f ? with < 0 : dot3(out.up, kFileAxes[2]) < 0) out.up = scaled3(out.up, -1);
  if (told.up) out.up = unit3(across(*told.up, out.forward));
  out.right = cross3(out.forward, out.up);
  return out;
}

void turn_to(std::span<SoupCorner> corners, const MeshAxes& axes) {
  for (SoupCorner& c : corners) {
    c.position = {dot3(c.position, axes.right), dot3(c.position, axes.forward), dot3(c.position, axes.up)};
  }
}

}  // namespace nt
