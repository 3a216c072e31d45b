// SPDX-License-Identifier: Apache-2.0
#include "app/author/mesh_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

constexpr int kLargestTexture = 2048;  // of one material alone
constexpr int kCell = 1024;            // of one of several
constexpr int kPatch = 16;             // of a plain colour
constexpr int kView = 640;             // longer side of a painted view

cv::Scalar scalar(uint32_t c) {
  return {static_cast<double>(c & 255), static_cast<double>(c >> 8 & 255), static_cast<double>(c >> 16 & 255),
          static_cast<double>(c >> 24)};
}

// Where each material lies in the atlas.
struct Cells {
  std::vector<cv::Rect> at;
  cv::Size size;
};

Cells lay_out(const std::vector<SoupMaterial>& materials) {
  const auto textured = static_cast<int>(
      std::count_if(materials.begin(), materials.end(), [](const SoupMaterial& m) { return !m.texture.empty(); }));
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(textured))));
  const int most = textured == 1 ? kLargestTexture : std::min(kCell, 4096 / columns);
  Cells cells;
  int placed = 0, row_y = 0, row_height = 0, x = 0;
  for (const SoupMaterial& m : materials) {
    cv::Rect r;
    if (!m.texture.empty()) {
      const double scale = std::min(1.0, static_cast<double>(most) / std::max(m.texture.cols, m.texture.rows));
      if (placed++ % columns == 0) row_y += row_height, row_height = 0, x = 0;
      r = {x, row_y, std::max(1, static_cast<int>(m.texture.cols * scale)),
           std::max(1, static_cast<int>(m.texture.rows * scale))};
      x += r.width, row_height = std::max(row_height, r.height);
      cells.size.width = std::max(cells.size.width, x);
    }
    cells.at.push_back(r);
  }
  // Plain colours in rows below.
  cells.size.width = std::max(cells.size.width, kPatch * 4);
  int y = row_y + row_height;
  x = 0;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!materials[i].texture.empty()) continue;
    if (x + kPatch > cells.size.width) x = 0, y += kPatch;
    cells.at[i] = {x, y, kPatch, kPatch};
    x += kPatch;
  }
  cells.size.height = x > 0 ? y + kPatch : std::max(y, 1);
  return cells;
}

// Brings a triangle's coordinates into one tile. True when it spans more than one.
bool into_tile(SoupCorner* c) {
  bool cut = false;
  for (float Vec2::*axis : {&Vec2::x, &Vec2::y}) {
    const float least = std::min({c[0].texcoord.*axis, c[1].texcoord.*axis, c[2].texcoord.*axis});
    const float most = std::max({c[0].texcoord.*axis, c[1].texcoord.*axis, c[2].texcoord.*axis});
    const float shift = least >= -1e-3f && most <= 1.001f ? 0.0f : std::floor(least + 1e-3f);
    cut = cut || most - shift > 1.01f;
    for (int k = 0; k < 3; ++k) c[k].texcoord.*axis = std::clamp(c[k].texcoord.*axis - shift, 0.0f, 1.0f);
  }
  return cut;
}

Vec2 within(const cv::Rect& cell, Vec2 uv, cv::Size atlas) {
  const auto at = [](float t, int from, int length, int all) {
    return (static_cast<float>(from) + 0.5f + t * static_cast<float>(length - 1)) / static_cast<float>(all);
  };
  return {at(uv.x, cell.x, cell.width, atlas.width), at(uv.y, cell.y, cell.height, atlas.height)};
}

Vec3 normal_of(const SoupCorner* c) {
  const Vec3 a = c[0].position, b = c[1].position, d = c[2].position;
  const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{d.x - a.x, d.y - a.y, d.z - a.z};
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

// Fills one triangle with its corners' colours, blended.
void paint(cv::Mat& picture, const std::array<cv::Point2f, 3>& p, const SoupCorner* c) {
  const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (std::abs(area) < 1e-6f) return;
  const int x0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].x, p[1].x, p[2].x})) - 1));
  const int x1 = std::min(picture.cols - 1, static_cast<int>(std::ceil(std::max({p[0].x, p[1].x, p[2].x})) + 1));
  const int y0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].y, p[1].y, p[2].y})) - 1));
  const int y1 = std::min(picture.rows - 1, static_cast<int>(std::ceil(std::max({p[0].y, p[1].y, p[2].y})) + 1));
  const cv::Scalar colour[3] = {scalar(c[0].colour), scalar(c[1].colour), scalar(c[2].colour)};
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const auto px = static_cast<float>(x), py = static_cast<float>(y);
      const float wa = ((p[1].x - px) * (p[2].y - py) - (p[1].y - py) * (p[2].x - px)) / area;
      const float wb = ((p[2].x - px) * (p[0].y - py) - (p[2].y - py) * (p[0].x - px)) / area;
      const float wc = 1 - wa - wb;
      if (std::min({wa, wb, wc}) < -0.05f) continue;  // a little over the edge: no gaps between neighbours
      const cv::Scalar sum = colour[0] * static_cast<double>(wa) + colour[1] * static_cast<double>(wb) +
                             colour[2] * static_cast<double>(wc);
      picture.at<cv::Vec4b>(y, x) = {cv::saturate_cast<uchar>(sum[0]), cv::saturate_cast<uchar>(sum[1]),
                                     cv::saturate_cast<uchar>(sum[2]), 255};
    }
  }
}

// Unpainted pixels take the colour of the nearest painted one.
void spread(cv::Mat& picture) {
  cv::Mat alpha, unused, labels;
  cv::extractChannel(picture, alpha, 3);
  const cv::Mat bare = alpha == 0;
  if (cv::countNonZero(bare) == static_cast<int>(bare.total())) return;
  cv::distanceTransform(bare, unused, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec4b> colour(bare.total() + 1);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (bare.at<uchar>(y, x) == 0)
        colour[static_cast<std::size_t>(labels.at<int>(y, x))] = picture.at<cv::Vec4b>(y, x);
    }
  }
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (bare.at<uchar>(y, x) != 0)
        picture.at<cv::Vec4b>(y, x) = colour[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
  }
}

}  // namespace

cv::Mat bake_atlas(MeshSoup& soup, int& cut) {
  const Cells cells = lay_out(soup.materials);
  cv::Mat atlas(cells.size, CV_8UC4, cv::Scalar(176, 176, 176, 255));
  for (std::size_t i = 0; i < soup.materials.size(); ++i) {
    const SoupMaterial& m = soup.materials[i];
    if (m.texture.empty()) atlas(cells.at[i]).setTo(scalar(m.colour));
    else cv::resize(m.texture, atlas(cells.at[i]), cells.at[i].size(), 0, 0, cv::INTER_AREA);
  }
  cut = 0;
  for (std::size_t t = 0; t < soup.material_of.size(); ++t) {
    SoupCorner* c = &soup.corners[3 * t];
    const cv::Rect cell = cells.at[soup.material_of[t]];
    const bool textured = !soup.materials[soup.material_of[t]].texture.empty();
    if (textured && into_tile(c)) ++cut;
    for (int k = 0; k < 3; ++k) c[k].texcoord = within(cell, textured ? c[k].texcoord : Vec2{0.5f, 0.5f}, cells.size);
  }
  return atlas;
}

cv::Mat bake_colours(MeshSoup& soup) {
  Vec3 least = soup.corners.front().position, most = least;
  for (const SoupCorner& c : soup.corners) {
    least = {std::min(least.x, c.position.x), std::min(least.y, c.position.y), std::min(least.z, c.position.z)};
    most = {std::max(most.x, c.position.x), std::max(most.y, c.position.y), std::max(most.z, c.position.z)};
  }
  const float scale = (kView - 4) / std::max({most.x - least.x, most.y - least.y, 1e-20f});
  const cv::Size view{static_cast<int>(std::ceil((most.x - least.x) * scale)) + 4,
                      static_cast<int>(std::ceil((most.y - least.y) * scale)) + 4};
  cv::Mat picture(view.height, 2 * view.width, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  const auto at = [&](Vec3 p) { return cv::Point2f((p.x - least.x) * scale + 2, (most.y - p.y) * scale + 2); };
  // The far ones first, so that what is seen is painted last; the right half is seen from below.
  std::vector<std::size_t> order(soup.material_of.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t t) {
    return soup.corners[3 * t].position.z + soup.corners[3 * t + 1].position.z + soup.corners[3 * t + 2].position.z;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (const bool below : {false, true}) {
      SoupCorner* c = &soup.corners[3 * (below ? order[order.size() - 1 - k] : order[k])];
      if ((normal_of(c).z < 0) != below) continue;
      cv::Mat half = picture(cv::Rect(below ? view.width : 0, 0, view.width, view.height));
      paint(half, {at(c[0].position), at(c[1].position), at(c[2].position)}, c);
      for (int i = 0; i < 3; ++i) {
        const cv::Point2f p = at(c[i].position);
        c[i].texcoord = {(p.x + 0.5f + static_cast<float>(below ? view.width : 0)) / static_cast<float>(picture.cols),
                         (p.y + 0.5f) / static_cast<float>(picture.rows)};
      }
    }
  }
  spread(picture);
  return picture;
}

}  // namespace nt
