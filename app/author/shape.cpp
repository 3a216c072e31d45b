// SPDX-License-Identifier: Apache-2.0
#include "app/author/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <queue>

namespace nt {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
// A tip stands out from its neighbours within this share of the outline, by this share of the farthest tip's way.
constexpr double kTipReach = 0.035, kTipRise = 0.025;
constexpr double kThick = 0.4;  // of the deepest: thinner stretches of a path count in proportion
constexpr int kMirrorGrid = 96;
constexpr double kMirrorStep_rad = 0.0436;  // 2.5 degrees

const cv::Point kSteps[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

std::vector<cv::Point> outer_border(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<cv::Point> longest;
  for (auto& c : contours) {
    if (c.size() > longest.size()) longest = c;
  }
  return longest;
}

// Whether values[i] is the largest within `reach` on a closed line, the first of equals, and how far it rises over the
// lower of the two feet.
bool is_peak(const std::vector<float>& values, int i, int reach, double rise) {
  const int n = static_cast<int>(values.size());
  const float top = values[static_cast<std::size_t>(i)];
  float foot[2] = {top, top};
  for (int side = 0; side < 2; ++side) {
    for (int k = 1; k <= reach; ++k) {
      const float v = values[static_cast<std::size_t>(((i + (side == 0 ? k : -k)) % n + n) % n)];
      if (v > top || (v == top && side == 1)) return false;
      foot[side] = std::min(foot[side], v);
    }
  }
  return top - std::max(foot[0], foot[1]) > rise;
}

}  // namespace

Shape::Shape(const cv::Mat& mask) {
  scale_ = std::min(1.0, static_cast<double>(kGrid - 4) / std::max(mask.cols, mask.rows));
  cv::Mat small;
  cv::resize(mask, small, {}, scale_, scale_, cv::INTER_AREA);
  cv::copyMakeBorder(small >= 96, cells_, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  // Shrinking may cut a thread: the largest piece stays.
  const std::vector<cv::Point> border = outer_border(cells_);
  if (!border.empty()) {
    cells_ = 0;
    cv::drawContours(cells_, std::vector<std::vector<cv::Point>>{border}, 0, 255, cv::FILLED);
  }
  cv::distanceTransform(cells_, depth_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::minMaxLoc(depth_, nullptr, &deepest_, nullptr, &deepest_at_);
}

Vec2 Shape::to_picture(cv::Point cell) const {
  const auto at = [&](int v) { return static_cast<float>((v - 1 + 0.5) / scale_ - 0.5); };
  return {at(cell.x), at(cell.y)};
}

cv::Point Shape::nearest_cell(Vec2 p) const {
  const auto at = [&](float v) { return static_cast<int>(std::floor((static_cast<double>(v) + 0.5) * scale_)) + 1; };
  const cv::Point wanted{at(p.x), at(p.y)};
  const cv::Rect all({0, 0}, cells_.size());
  if (all.contains(wanted) && cells_.at<uchar>(wanted) != 0) return wanted;
  cv::Point best = deepest_at_;
  double nearest = std::numeric_limits<double>::max();
  for (int y = 0; y < cells_.rows; ++y) {
    for (int x = 0; x < cells_.cols; ++x) {
      const double d = std::hypot(x - wanted.x, y - wanted.y);
      if (cells_.at<uchar>(y, x) != 0 && d < nearest) nearest = d, best = {x, y};
    }
  }
  return best;
}

// Dijkstra over the cells; a step costs its length, or, to keep to the middle, more the nearer the ground is.
Shape::Walk Shape::walk(cv::Point from, bool keep_to_middle) const {
  Walk w{cv::Mat(cells_.size(), CV_32F, cv::Scalar(static_cast<double>(kFar))),
         cv::Mat(cells_.size(), CV_32S, cv::Scalar(-1))};
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  w.cost.at<float>(from) = 0;
  open.emplace(0.0f, from.y * cells_.cols + from.x);
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    const cv::Point at{index % cells_.cols, index / cells_.cols};
    if (cost > w.cost.at<float>(at)) continue;
    for (const cv::Point step : kSteps) {
      const cv::Point next = at + step;  // the border of one cell around is ground
      if (cells_.at<uchar>(next) == 0) continue;
      float price = step.x != 0 && step.y != 0 ? 1.41421356f : 1.0f;
      if (keep_to_middle) price *= std::pow(static_cast<float>(deepest_) / depth_.at<float>(next), 1.5f);
      if (cost + price >= w.cost.at<float>(next)) continue;
      w.cost.at<float>(next) = cost + price;
      w.before.at<int>(next) = index;
      open.emplace(cost + price, next.y * cells_.cols + next.x);
    }
  }
  return w;
}

// Peaks of the way from `from` along the border, with the length of that way.
void Shape::collect_tips(const std::vector<cv::Point>& border, cv::Point from, std::vector<Tip>& out) const {
  const cv::Mat way = walk(from, false).cost;
  std::vector<float> values;
  float farthest = 0;
  for (const cv::Point p : border) {
    const float v = way.at<float>(p);
    values.push_back(std::isfinite(v) ? v : 0);
    farthest = std::max(farthest, values.back());
  }
  const int reach = std::max(3, static_cast<int>(kTipReach * static_cast<double>(border.size())));
  for (int i = 0; i < static_cast<int>(border.size()); ++i) {
    // The farthest point of all is an end, however blunt.
    const bool last = values[static_cast<std::size_t>(i)] == farthest;
    if (last || is_peak(values, i, reach, kTipRise * static_cast<double>(farthest))) {
      out.push_back({border[static_cast<std::size_t>(i)], values[static_cast<std::size_t>(i)]});
    }
  }
}

std::vector<Vec2> Shape::tips(std::size_t most) const {
  const std::vector<cv::Point> border = outer_border(cells_);
  std::vector<Tip> found;
  const auto farther = [](const Tip& a, const Tip& b) { return a.way > b.way; };
  collect_tips(border, deepest_at_, found);
  std::sort(found.begin(), found.end(), farther);
  // An end that holds the deepest point itself is no peak of the way from there, but is one of the way from the other end.
  if (!found.empty()) collect_tips(border, found.front().at, found);
  std::sort(found.begin(), found.end(), farther);
  std::vector<Tip> apart;
  const double near = kTipReach * static_cast<double>(border.size());
  for (const Tip& tip : found) {
    const auto same = [&](const Tip& o) { return cv::norm(tip.at - o.at) < 0.5 * near; };
    if (apart.size() < most && std::none_of(apart.begin(), apart.end(), same)) apart.push_back(tip);
  }
  std::vector<Vec2> out;
  for (const Tip& tip : apart) out.push_back(to_picture(tip.at));
  return out;
}

std::vector<Path> Shape::paths(Vec2 from, const std::vector<Vec2>& to) const {
  const Walk w = walk(nearest_cell(from), true);
  std::vector<Path> out;
  for (const Vec2 end : to) {
    Path path;
    cv::Point at = nearest_cell(end);
    if (!std::isfinite(w.cost.at<float>(at))) {
      out.push_back(path);
      continue;
    }
    path.points.push_back(to_picture(at));
    for (int before = w.before.at<int>(at); before >= 0; before = w.before.at<int>(at)) {
      const cv::Point next{before % cells_.cols, before / cells_.cols};
      const double step = std::hypot(next.x - at.x, next.y - at.y) / scale_;
      path.length += step;
      path.weight += step * std::min(1.0, static_cast<double>(depth_.at<float>(next)) / (kThick * deepest_));
      at = next;
      path.points.push_back(to_picture(at));
    }
    std::reverse(path.points.begin(), path.points.end());
    out.push_back(path);
  }
  return out;
}

Mirror Shape::mirror() const {
  cv::Mat small;
  const double shrink = static_cast<double>(kMirrorGrid) / kGrid;
  cv::resize(cells_, small, {}, shrink, shrink, cv::INTER_AREA);
  small = small >= 128;
  cv::copyMakeBorder(small, small, kMirrorGrid / 4, kMirrorGrid / 4, kMirrorGrid / 4, kMirrorGrid / 4,
                     cv::BORDER_CONSTANT, 0);
  const cv::Moments m = cv::moments(small, true);
  Mirror best;
  if (m.m00 <= 0) return best;
  for (double a = 0; a < CV_PI; a += kMirrorStep_rad) {
    const double c = std::cos(2 * a), s = std::sin(2 * a);
    for (const double shift : {0.0, -3.0, -1.5, 1.5, 3.0}) {
      const double x = m.m10 / m.m00 - shift * std::sin(a), y = m.m01 / m.m00 + shift * std::cos(a);
      const cv::Matx23d reflect(c, s, x - c * x - s * y, s, -c, y - s * x + c * y);
      cv::Mat image;
      cv::warpAffine(small, image, reflect, small.size(), cv::INTER_NEAREST);
      const double likeness = cv::countNonZero(image & small) / static_cast<double>(cv::countNonZero(image | small));
      // Of equals the one that stands upright, as most drawings do.
      if (likeness + 0.01 * std::abs(std::sin(a)) <= best.likeness) continue;
      best.likeness = likeness + 0.01 * std::abs(std::sin(a));
      const auto picture = [&](double v) {
        return static_cast<float>((((v - kMirrorGrid / 4 + 0.5) / shrink - 0.5) - 1 + 0.5) / scale_ - 0.5);
      };
      best.point = {picture(x), picture(y)};
      best.direction = {static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))};
    }
  }
  best.likeness = std::min(best.likeness, 1.0);
  return best;
}

std::vector<Vec2> Shape::crossings(Vec2 point, Vec2 direction) const {
  std::vector<Vec2> ends;
  constexpr int kReach = 4 * kGrid;  // half cells: from anywhere to anywhere
  for (int k = -kReach; k <= kReach; ++k) {
    const Vec2 p = point + direction * static_cast<float>(k / scale_ * 0.5);
    const cv::Point cell{static_cast<int>(std::floor((static_cast<double>(p.x) + 0.5) * scale_)) + 1,
                         static_cast<int>(std::floor((static_cast<double>(p.y) + 0.5) * scale_)) + 1};
    if (!cv::Rect({0, 0}, cells_.size()).contains(cell) || cells_.at<uchar>(cell) == 0) continue;
    if (ends.empty()) ends = {p, p};
    ends[1] = p;
  }
  return ends;
}

}  // namespace nt
