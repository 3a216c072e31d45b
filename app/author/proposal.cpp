// SPDX-License-Identifier: Apache-2.0
#include "app/author/proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/aligned_block.h"
#include "app/author/appendages.h"
#include "app/author/inner_axis.h"
#include "core/base/arena.h"
#include "core/outline/moments.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr float kToldOdds = 50.0f;    // a belief that the outline alone does not overturn
constexpr float kUnsure = 0.5f;       // a landmark group below this is named
constexpr float kOffMiddle = 0.2f;    // an axis point below this is named
constexpr float kMostWinding = 1.8f;  // radians; the tank's fish in a hard turn has 1.5
constexpr float kEndsAgree = 0.2f;    // of the length
constexpr double kFinsAhead = 0.55;   // along the axis: pectoral fins and arms are rooted ahead of here ...
constexpr double kFinsBehind = 0.4;   // ... or head and tail may be the wrong way round: what is left of being sure
constexpr float kLeastCentre = 0.2f,
                kMostCentre = 0.6f;  // along the axis: a curled figure's barycentre may lie anywhere

bool capture_landmarks(std::span<const Vec2> outline, cv::Size size, const FigureEnds& ends,
                       const LandmarkSettings& settings, FishPose& pose, Axis& axis) {
  Limits limits;
  limits.max_width = size.width, limits.max_height = size.height;
  limits.max_contour_points = std::max(limits.max_contour_points, static_cast<int>(outline.size()));
  Arena measure;
  Landmarks::create(measure, limits, settings);
  const AlignedBlock block(measure.used());
  Arena arena(block.bytes());
  Landmarks* landmarks = Landmarks::create(arena, limits, settings);
  LandmarkHints hints;
  std::array<Vec2, 2> told;
  if (!ends.path.points.empty()) {
    told = {ends.path.points.front(), ends.path.points.back()};
    hints.last = told, hints.head_log_odds = kToldOdds;
  }
  if (landmarks == nullptr || !landmarks->find(outline, hints, pose)) return false;
  pose.status = PoseStatus::ok;
  axis = resampled(landmarks->midline());
  return true;
}

// How much the axis winds, radians in all: fins off the middle make the capture's axis of a drawing zigzag.
float winding(const Axis& axis) {
  float sum = 0;
  for (std::size_t j = 2; j < axis.points.size(); ++j) {
    const Vec2 a = normalised(axis.points[j - 1] - axis.points[j - 2]),
               b = normalised(axis.points[j] - axis.points[j - 1]);
    sum += std::abs(std::atan2(cross(a, b), dot(a, b)));
  }
  return sum;
}

bool agree(const FishPose& pose, const Axis& axis, const FigureEnds& ends, const cv::Mat& mask) {
  if (ends.path.points.empty()) return true;
  const float reach = kEndsAgree * axis.length;
  return winding(axis) < kMostWinding && inside_figure(mask, axis.points) &&
         length(pose.head - ends.path.points.front()) < reach &&
         length(pose.tail - ends.path.points.back()) < 1.5f * reach;  // the notch lies before the tips of a fork
}

// As the capture samples its own axis ([F] section 4.3, end).
void sample(const Axis& axis, Vec2 barycentre, const LandmarkSettings& settings, FishPose& pose) {
  float best = 1e30f, s = 0.4f;
  for (float at = kLeastCentre; at <= kMostCentre; at += 0.01f) {
    const float d = length_sq(point_at(axis, at) - barycentre);
    if (d < best) best = d, s = at;
  }
  pose.status = PoseStatus::ok;
  pose.u_num = settings.u_num, pose.l_num = settings.l_num;
  pose.centre = point_at(axis, s);
  pose.head = axis.points.front(), pose.tail = axis.points.back();
  pose.axis_len = axis.length;
  for (int i = 0; i < settings.u_num; ++i) {
    pose.up_axis[i] = point_at(axis, s * (1 - static_cast<float>(i + 1) / static_cast<float>(settings.u_num + 1)));
  }
  for (int i = 0; i < settings.l_num; ++i) {
    pose.low_axis[i] = point_at(axis, s + (1 - s) * static_cast<float>(i + 1) / static_cast<float>(settings.l_num + 1));
  }
  pose.dir = normalised(pose.head - pose.tail);
}

// The nearest point of the figure: samples lie between stations, and a curl is narrower than they are apart.
Vec2 pulled_in(const cv::Mat& mask, Vec2 p) {
  const int x0 = static_cast<int>(std::lround(p.x)), y0 = static_cast<int>(std::lround(p.y));
  double nearest = 1e30;
  Vec2 best = p;
  for (int reach = 0; reach < std::max(mask.cols, mask.rows) && nearest > 1e29; ++reach) {
    for (int y = std::max(0, y0 - reach); y <= std::min(mask.rows - 1, y0 + reach); ++y) {
      for (int x = std::max(0, x0 - reach); x <= std::min(mask.cols - 1, x0 + reach); ++x) {
        const double d = std::hypot(x - static_cast<double>(p.x), y - static_cast<double>(p.y));
        if (mask.at<uchar>(y, x) != 0 && d < nearest)
          nearest = d, best = {static_cast<float>(x), static_cast<float>(y)};
      }
    }
    if (reach == 0 && nearest < 1e29) return p;
  }
  return best;
}

void keep_inside(const cv::Mat& mask, FishPose& pose) {
  for (Vec2* p : {&pose.centre, &pose.head, &pose.tail}) *p = pulled_in(mask, *p);
  for (int i = 0; i < pose.u_num; ++i) pose.up_axis[i] = pulled_in(mask, pose.up_axis[i]);
  for (int i = 0; i < pose.l_num; ++i) pose.low_axis[i] = pulled_in(mask, pose.low_axis[i]);
}

void copy_fins(const FishPose& pose, Proposal& out) {
  out.fins[kLeftFin] = {pose.confidence.l_fin > 0, pose.jun_tl, pose.jun_bl, pose.l_fin};
  out.fins[kRightFin] = {pose.confidence.r_fin > 0, pose.jun_tr, pose.jun_br, pose.r_fin};
}

void take_appendages(const Appendages& parts, Proposal& out) {
  for (std::size_t i = 0; i < parts.size(); ++i) out.fins[i] = parts[i].points;
  FishPose& p = out.pose;
  p.confidence.l_fin = parts[kLeftFin].confidence, p.confidence.r_fin = parts[kRightFin].confidence;
  const FinPoints &l = out.fins[kLeftFin], &r = out.fins[kRightFin];
  p.l_fin = l.tip, p.jun_tl = l.top, p.jun_bl = l.bottom;
  p.r_fin = r.tip, p.jun_tr = r.top, p.jun_br = r.bottom;
}

std::size_t nearest_station(const Axis& axis, Vec2 point) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < axis.points.size(); ++j) {
    if (length_sq(axis.points[j] - point) < length_sq(axis.points[best] - point)) best = j;
  }
  return best;
}

// In the order of a character file: centre, head, tail, upper axis, lower axis, fins.
std::vector<float> confidences_of(const Proposal& p, const cv::Mat& mask, const Axis& axis, const StationValues& body,
                                  const Appendages& parts) {
  const StationValues middle = centredness(mask, axis, body);
  const auto at = [&](Vec2 point) { return middle[nearest_station(axis, point)]; };
  std::vector<float> out{at(p.pose.centre), p.pose.confidence.head, p.pose.confidence.tail};
  for (int i = 0; i < p.pose.u_num; ++i) out.push_back(at(p.pose.up_axis[i]));
  for (int i = 0; i < p.pose.l_num; ++i) out.push_back(at(p.pose.low_axis[i]));
  for (std::size_t i = 0; i < kMaxFins; ++i) {
    float c = i == kLeftFin ? p.pose.confidence.l_fin : p.pose.confidence.r_fin;
    if (i >= kSecondLeftFin) c = parts[i].confidence;
    for (int k = 0; k < 3; ++k) out.push_back(p.fins[i].present ? c : 0.0f);
  }
  return out;
}

bool rooted_behind(const Proposal& p, const Axis& axis) {
  double along = 0;
  for (const FinIndex i : {kLeftFin, kRightFin}) {
    if (!p.fins[i].present) return false;
    const Vec2 root = lerp(p.fins[i].top, p.fins[i].bottom, 0.5f);
    along += 0.5 * static_cast<double>(nearest_station(axis, root)) / static_cast<double>(axis.points.size() - 1);
  }
  return along > kFinsAhead;
}

std::string percent(float v) {
  char text[16];
  std::snprintf(text, sizeof text, "%d %%", static_cast<int>(std::lround(v * 100)));
  return text;
}

// Runs of axis points off the middle, one line each.
void axis_doubts(const Proposal& p, std::size_t first, int count, const char* towards, std::vector<std::string>& out) {
  for (int i = 0; i < count; ++i) {
    int end = i;
    float least = 1;
    while (end < count && p.confidences[first + static_cast<std::size_t>(end)] < kOffMiddle) {
      least = std::min(least, p.confidences[first + static_cast<std::size_t>(end++)]);
    }
    if (end == i) continue;
    const std::string which = end == i + 1 ? "point " + std::to_string(end)
                                           : "points " + std::to_string(i + 1) + " to " + std::to_string(end);
    out.push_back("axis " + which + " towards the " + towards + (end - i > 1 ? " lie" : " lies") + " off the middle (" +
                  percent(least) + ")");
    i = end;
  }
}

}  // namespace

Proposal propose_landmarks(const std::string& name, const cv::Mat& mask, const cv::Mat& rgba,
                           std::span<const Vec2> outline, const std::optional<ToldHead>& told,
                           const LandmarkSettings& settings) {
  const Shape shape(mask);
  const std::vector<EyeSpot> eyes = rgba.empty() ? std::vector<EyeSpot>{} : eye_spots(rgba, mask);
  const FigureEnds ends = find_figure_ends(shape, mask, eyes, told);
  const Moments moments = polygon_moments(outline);
  std::vector<Vec2> clockwise(outline.begin(), outline.end());
  if (moments.area < 0) std::reverse(clockwise.begin(), clockwise.end());

  Proposal out;
  Axis axis;
  StationValues body{};
  out.by_capture =
      capture_landmarks(outline, mask.size(), ends, settings, out.pose, axis) && agree(out.pose, axis, ends, mask);
  if (!out.by_capture && ends.path.points.empty()) {
    throw UserError(name + ": the figure has no head and tail to be found; give a longer figure, or --head");
  }
  if (out.by_capture) {
    body = body_along(mask, clockwise, axis);
    copy_fins(out.pose, out);
  } else {
    const InnerAxis inner = inner_axis(mask, clockwise, ends.path, ends.tail_twin);
    axis = inner.axis, body = inner.body;
    sample(axis, moments.centroid, settings, out.pose);
    keep_inside(mask, out.pose);
  }
  const Appendages parts = find_appendages(mask, clockwise, axis, body);
  // The capture's fins are a fish's: one pair.
  const bool none = !out.fins[kLeftFin].present && !out.fins[kRightFin].present;
  if (none || parts[kSecondLeftFin].points.present) take_appendages(parts, out);
  out.has_tail_fin = ends.has_tail_fin;
  const bool known = !ends.path.points.empty();
  double sure = known ? ends.head_confidence * ends.ends_confidence : static_cast<double>(out.pose.confidence.head);
  if (!told && rooted_behind(out, axis)) sure *= kFinsBehind;
  out.pose.confidence.head = out.pose.confidence.tail = static_cast<float>(sure);
  out.confidences = confidences_of(out, mask, axis, body, parts);
  out.pose.confidence.centre = out.confidences[0];
  const auto first = out.confidences.begin() + 3;
  out.pose.confidence.axis = *std::min_element(first, first + settings.u_num + settings.l_num);
  return out;
}

std::vector<std::string> doubts_about(const Proposal& p) {
  std::vector<std::string> out;
  const PoseConfidence& c = p.pose.confidence;
  if (!p.fins[kLeftFin].present) out.push_back("left fin not seen: this character has none");
  if (!p.fins[kRightFin].present) out.push_back("right fin not seen: this character has none");
  if (c.head < kUnsure)
    out.push_back("head and tail are unsure (" + percent(c.head) + "): say where the head is with --head");
  if (p.fins[kLeftFin].present && c.l_fin < kUnsure) out.push_back("left fin is unsure (" + percent(c.l_fin) + ")");
  if (p.fins[kRightFin].present && c.r_fin < kUnsure) out.push_back("right fin is unsure (" + percent(c.r_fin) + ")");
  axis_doubts(p, 3, p.pose.u_num, "head", out);
  axis_doubts(p, 3 + static_cast<std::size_t>(p.pose.u_num), p.pose.l_num, "tail", out);
  return out;
}

}  // namespace nt
