// SPDX-License-Identifier: Apache-2.0
#include "app/author/appendages.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace nt {
namespace {

constexpr double kTubeSlack = 1.15, kTubeSlack_px = 2;  // the tube is this much wider than the body
constexpr double kLeastArea = 0.006;                    // of the figure
constexpr double kLeastReach = 0.07;                    // of the length, from root to tip
constexpr double kFirstRoot = 0.04, kLastRoot = 0.85;   // farther back it is the tail's own fin
constexpr float kBroadest = 1.5f;                       // root over reach: a bulge is no fin
constexpr double kPairApart = 0.2;                      // of the length: roots of a pair lie closer
constexpr double kSecondArea = 0.3;                     // of the first pair's: less is trimming

cv::Point pixel(Vec2 p) { return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))}; }

std::size_t nearest_station(const Axis& axis, Vec2 p) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < axis.points.size(); ++j) {
    if (length_sq(axis.points[j] - p) < length_sq(axis.points[best] - p)) best = j;
  }
  return best;
}

Vec2 nearest_point(std::span<const Vec2> outline, Vec2 p) {
  return *std::min_element(outline.begin(), outline.end(),
                           [&](Vec2 a, Vec2 b) { return length_sq(a - p) < length_sq(b - p); });
}

cv::Mat tube(const cv::Size size, const Axis& axis, const StationValues& body) {
  cv::Mat out = cv::Mat::zeros(size, CV_8U);
  for (std::size_t j = 0; j < axis.points.size(); ++j) {
    const double radius = kTubeSlack * static_cast<double>(body[j]) + kTubeSlack_px;
    cv::circle(out, pixel(axis.points[j]), static_cast<int>(std::lround(radius)), 255, cv::FILLED);
    if (j == 0) continue;
    const double before = kTubeSlack * static_cast<double>(body[j - 1]) + kTubeSlack_px;
    cv::line(out, pixel(axis.points[j - 1]), pixel(axis.points[j]), 255,
             std::max(1, static_cast<int>(2 * std::min(radius, before))));
  }
  return out;
}

// One part outside the tube, or nothing when it is too small, has no root, or is rooted where no fin is.
bool measure(const cv::Mat& part, const cv::Mat& body_tube, std::span<const Vec2> outline, const Axis& axis,
             double figure_area, Appendage& out, float& side) {
  out.area = cv::countNonZero(part);
  if (out.area < kLeastArea * figure_area) return false;
  cv::Mat grown;
  cv::dilate(part, grown, cv::getStructuringElement(cv::MORPH_RECT, {7, 7}));
  std::vector<cv::Point> contact, all;
  cv::findNonZero(grown & body_tube, contact);
  cv::findNonZero(part, all);
  if (contact.empty()) return false;
  Vec2 root;
  std::size_t first = kStations, last = 0;
  for (const cv::Point p : contact) {
    const Vec2 at{static_cast<float>(p.x), static_cast<float>(p.y)};
    root += at * (1.0f / static_cast<float>(contact.size()));
    const std::size_t j = nearest_station(axis, at);
    if (j < first) first = j, out.points.top = at;
    if (j >= last) last = j, out.points.bottom = at;
  }
  out.root = static_cast<double>(nearest_station(axis, root)) / (kStations - 1);
  float farthest = 0;
  for (const cv::Point p : all) {
    const Vec2 at{static_cast<float>(p.x), static_cast<float>(p.y)};
    const float d = length(at - root);
    if (d > farthest) farthest = d, out.points.tip = at;
  }
  if (out.root < kFirstRoot || out.root > kLastRoot) return false;
  if (static_cast<double>(farthest) < kLeastReach * static_cast<double>(axis.length)) return false;
  for (Vec2* p : {&out.points.top, &out.points.bottom, &out.points.tip}) *p = nearest_point(outline, *p);
  const float broad = length(out.points.top - out.points.bottom);
  if (broad < 2 || broad > kBroadest * farthest) return false;
  // With y down, cross(tangent, p) > 0 lies clockwise of the way from head to tail: the left of a swimmer.
  side = cross(tangent_at(axis, static_cast<float>(out.root)), root - point_at(axis, static_cast<float>(out.root)));
  out.points.present = true;
  out.confidence = static_cast<float>(std::clamp(out.area / (4 * kLeastArea * figure_area), 0.3, 1.0));
  return true;
}

// How well two parts make a pair, 0 where they do not.
double pairing(const Appendage& l, const Appendage& r) {
  const double apart = std::abs(l.root - r.root) / kPairApart;
  const double alike = std::min(l.area, r.area) / std::max(l.area, r.area);
  return apart >= 1 ? 0 : (l.area + r.area) * (1 - apart) * std::sqrt(alike);
}

void take_pair(std::vector<Appendage>& left, std::vector<Appendage>& right, double least, FinIndex as,
               Appendages& out) {
  std::size_t bl = 0, br = 0;
  double best = least;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      if (pairing(left[i], right[j]) > best) best = pairing(left[i], right[j]), bl = i + 1, br = j + 1;
    }
  }
  if (bl == 0) return;
  out[as] = left[bl - 1], out[static_cast<std::size_t>(as) + 1] = right[br - 1];
  left.erase(left.begin() + static_cast<std::ptrdiff_t>(bl - 1));
  right.erase(right.begin() + static_cast<std::ptrdiff_t>(br - 1));
}

// A part without a partner, of a figure seen from the side.
void take_single(std::vector<Appendage>& parts, FinIndex as, Appendages& out) {
  if (parts.empty()) return;
  const auto largest = std::max_element(parts.begin(), parts.end(),
                                        [](const Appendage& a, const Appendage& b) { return a.area < b.area; });
  out[as] = *largest;
  out[as].confidence *= 0.6f;
}

}  // namespace

Appendages find_appendages(const cv::Mat& mask, std::span<const Vec2> outline, const Axis& axis,
                           const StationValues& body) {
  const cv::Mat body_tube = tube(mask.size(), axis, body);
  cv::Mat rest = mask & ~body_tube, labels;
  cv::morphologyEx(rest, rest, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  const int count = cv::connectedComponents(rest, labels, 8);
  const double figure_area = cv::countNonZero(mask);
  std::vector<Appendage> left, right;
  for (int i = 1; i < count; ++i) {
    Appendage part;
    float side = 0;
    if (!measure(labels == i, body_tube, outline, axis, figure_area, part, side)) continue;
    (side > 0 ? left : right).push_back(part);
  }
  Appendages out;
  take_pair(left, right, 0, kLeftFin, out);
  if (!out[kLeftFin].points.present) {
    take_single(left, kLeftFin, out);
    take_single(right, kRightFin, out);
    return out;
  }
  const double first_area = out[kLeftFin].area + out[kRightFin].area;
  take_pair(left, right, kSecondArea * first_area * 0.5, kSecondLeftFin, out);
  if (out[kSecondLeftFin].points.present && out[kSecondLeftFin].root < out[kLeftFin].root) {
    std::swap(out[kLeftFin], out[kSecondLeftFin]);
    std::swap(out[kRightFin], out[kSecondRightFin]);
  }
  return out;
}

}  // namespace nt
