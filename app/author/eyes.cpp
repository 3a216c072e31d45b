// SPDX-License-Identifier: Apache-2.0
#include "app/author/eyes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

constexpr int kSide = 360;                       // pixels that the search is done on
constexpr double kLeast = 0.0004, kMost = 0.02;  // of the figure's area
constexpr double kRound = 0.72;                  // 4 pi area / perimeter^2: a disc of pixels has 0.8 to 0.9
constexpr double kContrast = 45;                 // grey levels
constexpr std::size_t kMostSpots = 4;

struct Candidate {
  cv::Point2d at;
  double radius = 0, weight = 0;
};

// The tone inside against the ring around; 0 unless most of the ring lies inside the figure.
double contrast(const cv::Mat& grey, const cv::Mat& mask, const std::vector<cv::Point>& contour, double radius) {
  const int grow = std::max(2, static_cast<int>(std::lround(radius * 0.8)));
  cv::Rect box = cv::boundingRect(contour);
  box = cv::Rect(box.x - grow, box.y - grow, box.width + 2 * grow, box.height + 2 * grow);
  if ((box & cv::Rect({0, 0}, grey.size())) != box) return 0;
  cv::Mat patch = cv::Mat::zeros(box.size(), CV_8U), ring;
  cv::drawContours(patch, std::vector<std::vector<cv::Point>>{contour}, 0, 255, cv::FILLED, cv::LINE_8, {}, 0,
                   -box.tl());
  cv::dilate(patch, ring, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * grow + 1, 2 * grow + 1}));
  ring &= ~patch;
  if (cv::countNonZero(ring & ~mask(box)) > cv::countNonZero(ring) / 3) return 0;
  cv::Scalar inside, inside_spread, around, around_spread;
  cv::meanStdDev(grey(box), inside, inside_spread, patch);
  cv::meanStdDev(grey(box), around, around_spread, ring & mask(box));
  return std::abs(inside[0] - around[0]) - 0.5 * around_spread[0];
}

void collect(const cv::Mat& grey, const cv::Mat& mask, const cv::Mat& patches, double figure_area,
             std::vector<Candidate>& found) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(patches, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  for (const auto& c : contours) {
    const double area = cv::contourArea(c), perimeter = cv::arcLength(c, true);
    if (area < std::max(6.0, kLeast * figure_area) || area > kMost * figure_area) continue;
    const double round = 4 * CV_PI * area / (perimeter * perimeter);
    if (round < kRound) continue;
    const double radius = std::sqrt(area / CV_PI);
    const double strength = contrast(grey, mask, c, radius);
    if (strength < kContrast) continue;
    const cv::Moments m = cv::moments(c);
    found.push_back({{m.m10 / m.m00, m.m01 / m.m00}, radius, std::min(1.0, strength / 150) * std::min(1.0, round)});
  }
}

// Two spots alike and not far apart are a pair of eyes.
void favour_twins(std::vector<Candidate>& spots) {
  std::vector<bool> twin(spots.size(), false);
  for (std::size_t i = 0; i < spots.size(); ++i) {
    for (std::size_t j = i + 1; j < spots.size(); ++j) {
      const double r = 0.5 * (spots[i].radius + spots[j].radius), apart = cv::norm(spots[i].at - spots[j].at) / r;
      const bool alike = std::abs(spots[i].radius - spots[j].radius) < 0.35 * r &&
                         std::abs(spots[i].weight - spots[j].weight) < 0.3 * spots[i].weight;
      if (alike && apart > 2.5 && apart < 14) twin[i] = twin[j] = true;
    }
  }
  // In a pattern of spots every one has a twin.
  if (std::count(twin.begin(), twin.end(), true) > 4) return;
  for (std::size_t i = 0; i < spots.size(); ++i) spots[i].weight *= twin[i] ? 1.5 : 0.8;
  std::sort(spots.begin(), spots.end(), [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
}

}  // namespace

std::vector<EyeSpot> eye_spots(const cv::Mat& rgba, const cv::Mat& mask) {
  const double scale = std::min(1.0, static_cast<double>(kSide) / std::max(rgba.cols, rgba.rows));
  cv::Mat grey, small_mask;
  cv::cvtColor(rgba, grey, cv::COLOR_RGBA2GRAY);
  cv::resize(grey, grey, {}, scale, scale, cv::INTER_AREA);
  cv::resize(mask, small_mask, grey.size(), 0, 0, cv::INTER_AREA);
  small_mask = small_mask >= 128;
  const double figure_area = cv::countNonZero(small_mask);
  std::vector<Candidate> found;
  for (int level = 24; level < 255; level += 24) {
    collect(grey, small_mask, (grey < level) & small_mask, figure_area, found);
    collect(grey, small_mask, (grey >= level) & small_mask, figure_area, found);
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
  std::vector<Candidate> apart;  // the same spot is seen at many thresholds
  for (const Candidate& c : found) {
    const auto same = [&](const Candidate& o) { return cv::norm(c.at - o.at) < 2 * std::max(c.radius, o.radius); };
    if (std::none_of(apart.begin(), apart.end(), same)) apart.push_back(c);
  }
  favour_twins(apart);
  std::vector<EyeSpot> out;
  // Two eyes are ordinary; a row of spots is a pattern.
  const double share = apart.size() <= 2 ? 1.0 : 2.0 / static_cast<double>(std::min<std::size_t>(apart.size(), 8));
  for (const Candidate& c : apart) {
    if (out.size() == kMostSpots || c.weight < 0.75 * apart.front().weight) break;
    out.push_back(
        {{static_cast<float>(c.at.x / scale), static_cast<float>(c.at.y / scale)}, std::min(1.0, c.weight * share)});
  }
  return out;
}

}  // namespace nt
