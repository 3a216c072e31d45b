// SPDX-License-Identifier: Apache-2.0
#include "app/author/inner_axis.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace nt {
namespace {

constexpr int kRounds = 12;           // of smoothing: about 3 stations of a Gaussian
constexpr float kEndSlack_px = 4;     // an end on the outline may lie just outside
constexpr float kWidestBody = 1.25f;  // of the distance from the axis to the nearest outline
constexpr float kRayReach = 1.6f;     // of the body's half width: beyond it a ray is in a fin

bool in_mask(const cv::Mat& mask, Vec2 p) {
  const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
  return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask.at<uchar>(y, x) != 0;
}

std::size_t nearest_index(std::span<const Vec2> points, Vec2 p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (length_sq(points[i] - p) < length_sq(points[best] - p)) best = i;
  }
  return best;
}

bool segment_inside(const cv::Mat& mask, Vec2 a, Vec2 b) {
  const int steps = std::max(1, static_cast<int>(length(b - a)));
  for (int k = 0; k <= steps; ++k) {
    if (!in_mask(mask, lerp(a, b, static_cast<float>(k) / static_cast<float>(steps)))) return false;
  }
  return true;
}

// Averages each station with its neighbours where that keeps it and the way to them inside.
void smooth_inside(const cv::Mat& mask, Axis& axis) {
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t j = 1; j + 1 < axis.points.size(); ++j) {
      const Vec2 wanted = axis.points[j] * 0.5f + (axis.points[j - 1] + axis.points[j + 1]) * 0.25f;
      const bool end = j < 3 || j + 4 > axis.points.size();
      // The ends lie on the outline, where pixels round either way.
      const bool clear =
          segment_inside(mask, axis.points[j - 1], wanted) && segment_inside(mask, wanted, axis.points[j + 1]);
      if (end ? in_mask(mask, wanted) : clear) {
        axis.points[j] = wanted;
      }
    }
  }
  axis = resampled(axis.points);
}

Stretch right_side(std::span<const Vec2> outline, const Axis& axis) {
  const auto head = static_cast<int>(nearest_index(outline, axis.points.front()));
  const auto tail = static_cast<int>(nearest_index(outline, axis.points.back()));
  const auto n = static_cast<int>(outline.size());
  return {head, ((tail - head) % n + n) % n};
}

// The outline's point half-way between two of its points, the short way round.
std::size_t between(std::size_t a, std::size_t b, std::size_t n) {
  const std::size_t ahead = (b + n - a) % n;
  return ahead <= n / 2 ? (a + ahead / 2) % n : (b + (n - ahead) / 2) % n;
}

// The path's points from the outline at the head to the outline at the tail.
std::vector<Vec2> between_ends(std::span<const Vec2> outline, const Path& path, std::optional<Vec2> twin) {
  std::vector<Vec2> line = path.points;
  line.front() = outline[nearest_index(outline, line.front())];
  const std::size_t tail = nearest_index(outline, line.back());
  if (!twin) {
    line.back() = outline[tail];
    return line;
  }
  const Vec2 end = outline[between(tail, nearest_index(outline, *twin), outline.size())];
  // Leaves the way to the corner where it is still in the stem.
  const float fin = 1.1f * length(end - outline[tail]);
  while (line.size() > 2 && length(line.back() - end) < fin) line.pop_back();
  line.push_back(end);
  return line;
}

}  // namespace

bool inside_figure(const cv::Mat& mask, std::span<const Vec2> line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (in_mask(mask, line[i])) continue;
    const bool end = length(line[i] - line.front()) < kEndSlack_px || length(line[i] - line.back()) < kEndSlack_px;
    if (!end) return false;
  }
  return true;
}

InnerAxis inner_axis(const cv::Mat& mask, std::span<const Vec2> outline, const Path& path, std::optional<Vec2> twin) {
  InnerAxis inner;
  inner.axis = resampled(between_ends(outline, path, twin));
  if (twin && !inside_figure(mask, inner.axis.points)) inner.axis = resampled(between_ends(outline, path, {}));
  smooth_inside(mask, inner.axis);
  inner.body = body_along(mask, outline, inner.axis);
  return inner;
}

StationValues centredness(const cv::Mat& mask, const Axis& axis, const StationValues& body) {
  StationValues out{};
  for (std::size_t j = 0; j < out.size(); ++j) {
    const Vec2 across = right_of(tangent_at(axis, static_cast<float>(j) / (kStations - 1)));
    float reach[2] = {};
    for (int side = 0; side < 2; ++side) {
      const float most = kRayReach * body[j] + 2;
      const Vec2 step = side == 0 ? across : across * -1.0f;
      while (reach[side] < most && in_mask(mask, axis.points[j] + step * (reach[side] + 1))) reach[side] += 1;
    }
    out[j] = (std::min(reach[0], reach[1]) + 1) / (std::max(reach[0], reach[1]) + 1);
  }
  return out;
}

StationValues body_along(const cv::Mat& mask, std::span<const Vec2> outline, const Axis& axis) {
  cv::Mat depth;
  cv::distanceTransform(mask, depth, cv::DIST_L2, 5);
  std::vector<AlongAxis> along(outline.size());
  const Stretch right = right_side(outline, axis);
  project_outline(outline, right, axis, along);
  StationValues body = body_half_width(width_profile(along, right));
  for (std::size_t j = 0; j < body.size(); ++j) {
    // A claw that reaches ahead of the head counts as width there; the nearest outline says otherwise.
    const int x = std::clamp(static_cast<int>(std::lround(axis.points[j].x)), 0, mask.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(axis.points[j].y)), 0, mask.rows - 1);
    body[j] = std::clamp(body[j], 1.0f, kWidestBody * depth.at<float>(y, x) + 1);
  }
  return body;
}

}  // namespace nt
