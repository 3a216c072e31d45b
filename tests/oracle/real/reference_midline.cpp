// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/real/reference_midline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <opencv2/imgproc.hpp>

namespace nt::test {
namespace {

constexpr int kPoints = 129;
constexpr double kSmooth =
    0.015;  // sigma along the path, share of its length: a path over pixels has steps of 45 degrees

double median_of(const cv::Mat& picture) {
  std::vector<float> values(picture.begin<float>(), picture.end<float>());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The greatest of 12 averages along short lines of all directions: a tail two pixels wide stays, noise goes.
cv::Mat smoothed_along_lines(const cv::Mat& picture, double along) {
  constexpr int kDirections = 12;
  constexpr double kAcross = 0.9;
  const int reach = static_cast<int>(2.5 * along);
  cv::Mat greatest, one;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = CV_PI * k / kDirections, c = std::cos(angle), s = std::sin(angle);
    cv::Mat kernel(2 * reach + 1, 2 * reach + 1, CV_32F);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double u = (c * x + s * y) / along, v = (c * y - s * x) / kAcross;
        kernel.at<float>(y + reach, x + reach) = static_cast<float>(std::exp(-0.5 * (u * u + v * v)));
      }
    }
    kernel /= cv::sum(kernel)[0];
    cv::filter2D(picture, one, CV_32F, kernel);
    if (greatest.empty()) greatest = one.clone();
    else cv::max(greatest, one, greatest);
  }
  return greatest;
}

cv::Mat fish_mask(const cv::Mat& frame, const cv::Mat& ground, const ReferenceSettings& s) {
  cv::Mat clean = frame;
  if (s.median_filter > 0) cv::medianBlur(clean, clean, s.median_filter);
  cv::Mat value, base;
  clean.convertTo(value, CV_32F);
  if (s.ground < 0) base = cv::Mat(value.size(), CV_32F, cv::Scalar(median_of(value)));
  else ground.convertTo(base, CV_32F);
  cv::Mat difference = s.bright ? cv::Mat(value - base) : cv::Mat(base - value);
  difference -= median_of(difference);  // the lamp's flicker
  if (s.blur > 0) cv::GaussianBlur(difference, difference, {}, s.blur);
  if (s.along > 0) {
    // Only around the strongest spot, with room for the whole fish: the rest of the dish is no fish.
    cv::Mat calm;
    cv::GaussianBlur(difference, calm, {}, 2);
    cv::Point spot;
    cv::minMaxLoc(calm, nullptr, nullptr, nullptr, &spot);
    const cv::Rect box =
        cv::Rect(spot.x - s.reach, spot.y - s.reach, 2 * s.reach, 2 * s.reach) & cv::Rect({}, frame.size());
    cv::Mat there = cv::Mat::zeros(difference.size(), CV_32F);
    smoothed_along_lines(difference(box), s.along).copyTo(there(box));
    difference = there;
  }
  // The fish is the part over `weak` with most pixels over `strong` that keeps clear of the frame's edge (a dark corner, a dish's rim do not).
  const cv::Mat strong = difference > s.strong;
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(difference > s.weak, labels, stats, centroids);
  std::vector<int> seeds(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      seeds[static_cast<std::size_t>(labels.at<int>(y, x))] += strong.at<uint8_t>(y, x) != 0;
  int best = 0, most = 0;
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (box.x == 0 || box.y == 0 || box.br().x == labels.cols || box.br().y == labels.rows) continue;
    if (seeds[static_cast<std::size_t>(i)] > most) most = seeds[static_cast<std::size_t>(i)], best = i;
  }
  cv::Mat fish = best > 0 ? cv::Mat(labels == best) : cv::Mat::zeros(labels.size(), CV_8U);
  // Holes (a light eye) are no way round.
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(fish.clone(), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat holes = fish.clone();
  cv::drawContours(holes, contours, -1, cv::Scalar(255), cv::FILLED);
  holes &= ~fish;
  const int parts = cv::connectedComponentsWithStats(holes, labels, stats, centroids, 4);
  const double area = cv::countNonZero(fish);
  for (int i = 1; i < parts; ++i)  // a large one is water inside a ring
    if (stats.at<int>(i, cv::CC_STAT_AREA) < 0.05 * area) fish |= labels == i;
  return fish;
}

// Dijkstra over the mask's pixels, 8 neighbours; `centre`: a step costs its length over the squared distance from the rim.
struct Paths {
  cv::Mat cost;  // CV_64F
  cv::Mat from;  // CV_32S, index of the pixel before, -1 at the start
};

Paths paths_from(cv::Point start, const cv::Mat& mask, const cv::Mat& rim, bool centre) {
  const int w = mask.cols;
  Paths paths{cv::Mat(mask.size(), CV_64F, cv::Scalar(std::numeric_limits<double>::infinity())),
              cv::Mat(mask.size(), CV_32S, cv::Scalar(-1))};
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  paths.cost.at<double>(start) = 0;
  open.push({0.0, start.y * w + start.x});
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    const cv::Point p(index % w, index / w);
    if (cost > paths.cost.at<double>(p)) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point q = p + cv::Point(dx, dy);
        if (p == q || !cv::Rect({}, mask.size()).contains(q) || mask.at<uint8_t>(q) == 0) continue;
        const double r = rim.at<float>(q);
        const double step = std::hypot(dx, dy) / (centre ? r * r : 1.0);
        if (cost + step >= paths.cost.at<double>(q)) continue;
        paths.cost.at<double>(q) = cost + step;
        paths.from.at<int>(q) = index;
        open.push({cost + step, q.y * w + q.x});
      }
    }
  }
  return paths;
}

cv::Point farthest(const Paths& paths) {
  cv::Mat reached;
  paths.cost.copyTo(reached);
  reached.setTo(-1, paths.cost == std::numeric_limits<double>::infinity());
  cv::Point at;
  cv::minMaxLoc(reached, nullptr, nullptr, nullptr, &at);
  return at;
}

double length_of(const std::vector<cv::Point2d>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += cv::norm(line[i] - line[i - 1]);
  return sum;
}

std::vector<cv::Point2d> evenly(const std::vector<cv::Point2d>& line, int count) {
  const double step = length_of(line) / (count - 1);
  std::vector<cv::Point2d> out{line.front()};
  double walked = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double here = cv::norm(line[i] - line[i - 1]);
    while (static_cast<int>(out.size()) < count - 1 && walked + here >= step * static_cast<double>(out.size())) {
      const double u = (step * static_cast<double>(out.size()) - walked) / std::max(here, 1e-9);
      out.push_back(line[i - 1] + (line[i] - line[i - 1]) * u);
    }
    walked += here;
  }
  while (static_cast<int>(out.size()) < count) out.push_back(line.back());
  return out;
}

std::vector<cv::Point2d> smooth(const std::vector<cv::Point2d>& line, double sigma_points) {
  const int n = static_cast<int>(line.size()), reach = static_cast<int>(3 * sigma_points) + 1;
  std::vector<cv::Point2d> out;
  for (int i = 0; i < n; ++i) {
    // A window that shrinks towards the ends, so that these stay.
    const int r = std::min({reach, i, n - 1 - i});
    cv::Point2d sum;
    double weights = 0;
    for (int k = -r; k <= r; ++k) {
      const double w = std::exp(-0.5 * k * k / (sigma_points * sigma_points));
      sum += line[static_cast<std::size_t>(i + k)] * w, weights += w;
    }
    out.push_back(sum * (1 / weights));
  }
  return out;
}

bool inside(const cv::Mat& mask, cv::Point2d p) {
  const cv::Point q(cvRound(p.x), cvRound(p.y));
  return cv::Rect({}, mask.size()).contains(q) && mask.at<uint8_t>(q) != 0;
}

// The half-width near the end (the back) of the path.
double end_radius(const std::vector<cv::Point2d>& line, const cv::Mat& rim) {
  const double length = length_of(line);
  double radius = 0, walked = 0;
  for (std::size_t i = line.size() - 1; i > 0 && walked < 0.1 * length; --i) {
    radius = std::max(radius, static_cast<double>(rim.at<float>(cvRound(line[i].y), cvRound(line[i].x))));
    walked += cv::norm(line[i] - line[i - 1]);
  }
  return radius;
}

// Cuts the end of the path (its back) by the half-width near it, or by `fork` of the length before a forked tail parts, and
// runs straight on to the rim of the mask.
void straighten_end(std::vector<cv::Point2d>& line, const cv::Mat& mask, double radius, double fork) {
  const double length = length_of(line);
  const double cut = std::max(std::min(1.8 * radius, 0.16 * length), fork * length);
  while (line.size() > 8 && cut > 0) {
    const cv::Point2d end = line.back();
    double back = 0;
    std::size_t keep = line.size() - 1;
    while (keep > 4 && back < cut) back += cv::norm(line[keep] - line[keep - 1]), --keep;
    line.resize(keep + 1);
    double base = 0;
    std::size_t from = line.size() - 1;
    while (from > 0 && base < std::max(0.1 * length, 4.0)) base += cv::norm(line[from] - line[from - 1]), --from;
    cv::Point2d dir = line.back() - line[from];
    dir *= 1 / std::max(cv::norm(dir), 1e-9);
    // As far as the fish goes; a nick one pixel deep is no end.
    double reach = 0;
    for (double t = 0; t <= 2 * cut + 4; t += 0.25)
      if (inside(mask, line.back() + dir * t)) reach = t;
      else if (t > reach + 1.5) break;
    line.push_back(reach > 0 ? line.back() + dir * reach : end);
    return;
  }
}

}  // namespace

cv::Mat clip_quantile(const std::vector<cv::Mat>& frames, double quantile) {
  cv::Mat out(frames.at(0).size(), CV_8U);
  std::vector<uint8_t> values(frames.size());
  const auto at = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(frames.size() - 1));
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      for (std::size_t i = 0; i < frames.size(); ++i) values[i] = frames[i].at<uint8_t>(y, x);
      std::nth_element(values.begin(), values.begin() + at, values.end());
      out.at<uint8_t>(y, x) = values[static_cast<std::size_t>(at)];
    }
  }
  return out;
}

ReferencePose reference_midline(const cv::Mat& frame, const cv::Mat& ground, const ReferenceSettings& settings) {
  ReferencePose pose;
  pose.mask = fish_mask(frame, ground, settings);
  cv::Rect box = cv::boundingRect(pose.mask);
  if (box.area() < 100) return pose;
  box = cv::Rect(box.x - 1, box.y - 1, box.width + 2, box.height + 2) & cv::Rect({}, frame.size());
  const cv::Mat mask = pose.mask(box).clone();
  cv::Mat rim;
  cv::distanceTransform(mask, rim, cv::DIST_L2, cv::DIST_MASK_PRECISE);

  cv::Point start;
  cv::minMaxLoc(rim, nullptr, nullptr, nullptr, &start);
  const cv::Point one = farthest(paths_from(start, mask, rim, false));
  const cv::Point other = farthest(paths_from(one, mask, rim, false));
  const Paths middle = paths_from(one, mask, rim, true);
  std::vector<cv::Point2d> line;
  for (int i = other.y * mask.cols + other.x; i >= 0; i = middle.from.at<int>(i / mask.cols, i % mask.cols))
    line.emplace_back(i % mask.cols, i / mask.cols);
  if (line.size() < 16) return pose;

  line = smooth(evenly(line, kPoints), kSmooth * kPoints);
  const double back = end_radius(line, rim);
  std::reverse(line.begin(), line.end());
  const double front = end_radius(line, rim);  // the thinner end is the tail
  straighten_end(line, mask, front, front < back ? settings.fork : 0);
  std::reverse(line.begin(), line.end());
  straighten_end(line, mask, back, front < back ? 0 : settings.fork);
  line = evenly(line, kPoints);
  for (cv::Point2d& p : line) p += cv::Point2d(box.tl());
  pose.midline = line;
  pose.length = length_of(line);
  pose.found = true;
  return pose;
}

}  // namespace nt::test
