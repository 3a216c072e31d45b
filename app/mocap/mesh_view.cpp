// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/mesh_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "app/mocap/marker_file.h"

namespace nt {

MeshView::MeshView(int width, int height, Quat turn, float half_height)
    : width_(width),
      height_(height),
      turn_(turn),
      scale_(0.5f * static_cast<float>(height) / half_height),
      picture_(height, width, CV_8UC3),
      depth_(height, width, CV_32F) {}

Vec3 MeshView::project(Vec3 p, Vec3 centre) const {
  const Vec3 r = rotate(turn_, p - centre) * scale_;
  return {0.5f * static_cast<float>(width_) + r.x, 0.5f * static_cast<float>(height_) - r.y, r.z};
}

void MeshView::fill(Vec3 a, Vec3 b, Vec3 c, float light) {
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (area == 0.0f || !std::isfinite(area)) return;
  const auto shade = static_cast<uint8_t>(40.0f + 190.0f * light);
  const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x})))),
            x1 = std::min(width_ - 1, static_cast<int>(std::max({a.x, b.x, c.x})));
  const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y})))),
            y1 = std::min(height_ - 1, static_cast<int>(std::max({a.y, b.y, c.y})));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float px = static_cast<float>(x), py = static_cast<float>(y);
      const float u = ((b.x - px) * (c.y - py) - (c.x - px) * (b.y - py)) / area;
      const float v = ((c.x - px) * (a.y - py) - (a.x - px) * (c.y - py)) / area;
      if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      const float z = u * a.z + v * b.z + (1.0f - u - v) * c.z;
      if (z <= depth_.at<float>(y, x)) continue;
      depth_.at<float>(y, x) = z;
      picture_.at<cv::Vec3b>(y, x) = {shade, static_cast<uint8_t>(shade * 0.85), static_cast<uint8_t>(shade * 0.7)};
    }
  }
}

const cv::Mat& MeshView::draw(std::span<const float> places, const std::vector<uint32_t>& triangles,
                              std::span<const Vec3> markers, Vec3 centre) {
  picture_.setTo(cv::Scalar(250, 248, 245));
  depth_.setTo(-1e9f);
  std::vector<Vec3> at(places.size() / 3);
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = project({places[3 * i], places[3 * i + 1], places[3 * i + 2]}, centre);
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Vec3 a = at[triangles[t]], b = at[triangles[t + 1]], c = at[triangles[t + 2]];
    fill(a, b, c, std::abs(normalised(cross(b - a, c - a)).z));
  }
  for (const Vec3 m : markers) {
    if (!is_seen(m)) continue;
    const Vec3 p = project(m, centre);
    cv::circle(picture_, {static_cast<int>(p.x), static_cast<int>(p.y)}, 3, {220, 30, 30}, cv::FILLED, cv::LINE_AA);
  }
  return picture_;
}

}  // namespace nt
