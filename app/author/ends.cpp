// SPDX-License-Identifier: Apache-2.0
#include "app/author/ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

constexpr std::size_t kMostTips = 14;
constexpr double kSymmetric = 0.60;       // likeness from which the mirror line means something
constexpr double kFullySymmetric = 0.82;  // thin limbs never lie on their images
constexpr double kMirrorBonus = 1.0;      // at full likeness; the best pair's way counts 1
constexpr double kTwinPenalty = 0.5;
constexpr double kLongEnough = 0.35;
constexpr double kEyeBonus = 0.6;
constexpr double kTailBonus = 0.2;
constexpr double kEyeNear = 0.18,
                 kEyeReach = 0.4;   // of the figure's length: farther from an end eyes say nothing of it
constexpr double kFaceFound = 0.6;  // nearness of the eyes to an end from which that end is the face
constexpr double kOnLine = 0.05;    // of the length: as near to the mirror line lies an end that is on it
constexpr double kAlongLine = 0.1;  // of the length: as far the way between two ends may leave it
constexpr double kTwinLength = 0.15, kTwinApart = 0.42;  // of the length: the corners of one tail fin
constexpr double kClearLead = 0.35;                      // of score over the next pair: no doubt

// The figure's half width at 33 stations along a path, by its distance field.
std::array<double, 33> widths_along(const cv::Mat& depth, const Path& path) {
  std::array<double, 33> out{};
  for (std::size_t j = 0; j < out.size(); ++j) {
    const Vec2 p = path.points[j * (path.points.size() - 1) / (out.size() - 1)];
    const cv::Point at{std::clamp(static_cast<int>(std::lround(p.x)), 0, depth.cols - 1),
                       std::clamp(static_cast<int>(std::lround(p.y)), 0, depth.rows - 1)};
    out[j] = static_cast<double>(depth.at<float>(at));
  }
  return out;
}

// How much the end at the back of a profile looks like a caudal fin: a stem narrower than both the body before it and
// what follows. 0 to 1.
double caudal(const std::array<double, 33>& w) {
  const double body = *std::max_element(w.begin(), w.begin() + 22);
  double best = 0;
  for (std::size_t stem = 16; stem < 31; ++stem) {
    const double after = *std::max_element(w.begin() + static_cast<std::ptrdiff_t>(stem), w.end());
    const double narrow = 1 - w[stem] / std::max(body, 1e-6), wider = after / std::max(w[stem], 1e-6) - 1;
    best = std::max(best, std::clamp(2 * narrow - 0.6, 0.0, 1.0) * std::clamp(2.5 * wider, 0.0, 1.0));
  }
  return best;
}

double front_half(const std::array<double, 33>& w) {
  double sum = 0;
  for (std::size_t j = 1; j < 14; ++j) sum += w[j];
  return sum;
}

class Judge {
 public:
  Judge(const Shape& shape, const cv::Mat& mask, const std::vector<EyeSpot>& eyes) : shape_(shape), eyes_(eyes) {
    cv::Mat padded;
    cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::distanceTransform(padded, depth_, cv::DIST_L2, 5);
    depth_ = depth_(cv::Rect({1, 1}, mask.size()));
    mirror_ = shape.mirror();
    tips_ = shape.tips(kMostTips);
    if (mirror_.likeness > kSymmetric) {
      for (const Vec2 p : shape.crossings(mirror_.point, mirror_.direction)) tips_.push_back(p);
    }
    eyes_mirrored_ = eyes_mirrored();
    add_face();
  }
  FigureEnds judge(const std::optional<ToldHead>& told);

 private:
  struct Pair {
    Path path;
    double score = 0;
    bool on_mirror = false;
  };
  double eye_nearness(Vec2 end, double length) const;
  double distance_to_mirror(Vec2 p) const {
    return std::abs(static_cast<double>(cross(mirror_.direction, p - mirror_.point)));
  }
  double eyes_mirrored() const;
  void add_face();
  std::vector<Pair> pairs() const;
  void score(Pair& pair, double heaviest) const;
  void penalise_twins(std::vector<Pair>& all, double heaviest) const;
  double head_log_odds(const Path& path, bool& tail_fin) const;
  std::optional<Vec2> twin_of(const Path& path, const std::vector<Pair>& all) const;
  std::optional<Vec2> told_end(const ToldHead& told) const;

  const Shape& shape_;
  const std::vector<EyeSpot>& eyes_;
  cv::Mat depth_;
  Mirror mirror_;
  double eyes_mirrored_ = 1;
  std::vector<Vec2> tips_;
};

// 1 where the eyes lie within kEyeNear of the end, 0 from kEyeReach on; weighted by how much they look like eyes.
double Judge::eye_nearness(Vec2 end, double len) const {
  double sum = 0, weights = 1e-9;
  for (const EyeSpot& eye : eyes_) {
    const double away = static_cast<double>(length(eye.at - end)) / std::max(len, 1.0);
    sum += eye.weight * eye.weight * std::clamp((kEyeReach - away) / (kEyeReach - kEyeNear), 0.0, 1.0);
    weights += eye.weight;
  }
  return sum / weights;
}

// 1 where every eye has its mirror image or lies on the line; a fish from the side is an oval, but has one eye.
double Judge::eyes_mirrored() const {
  const auto reach = static_cast<float>(0.04 * std::hypot(depth_.cols, depth_.rows));
  double odd = 0;
  for (const EyeSpot& eye : eyes_) {
    const Vec2 off = eye.at - mirror_.point;
    const Vec2 image = mirror_.point + mirror_.direction * (2 * dot(off, mirror_.direction)) - off;
    const auto meets = [&](const EyeSpot& other) { return length(other.at - image) < reach; };
    if (std::none_of(eyes_.begin(), eyes_.end(), meets)) odd = std::max(odd, eye.weight);
  }
  return std::clamp(1 - 1.5 * odd, 0.2, 1.0);
}

// A face has no tip: where the eyes lie far from all of them, the head is where the way from the tip farthest from them through
// the eyes leaves the figure.
void Judge::add_face() {
  if (eyes_.empty() || tips_.empty()) return;
  const double across = std::hypot(depth_.cols, depth_.rows);
  for (const Vec2 tip : tips_) {
    if (eye_nearness(tip, across) > kFaceFound) return;
  }
  Vec2 eyes;
  double weights = 0;
  for (const EyeSpot& eye : eyes_) eyes += eye.at * static_cast<float>(eye.weight), weights += eye.weight;
  eyes = eyes * static_cast<float>(1 / weights);
  const Vec2 far = *std::max_element(tips_.begin(), tips_.end(),
                                     [&](Vec2 a, Vec2 b) { return length(a - eyes) < length(b - eyes); });
  const std::vector<Vec2> ends = shape_.crossings(eyes, normalised(eyes - far));
  if (!ends.empty()) tips_.push_back(ends.back());
}

std::vector<Judge::Pair> Judge::pairs() const {
  std::vector<Pair> out;
  for (std::size_t i = 0; i + 1 < tips_.size(); ++i) {
    const std::vector<Vec2> others(tips_.begin() + static_cast<std::ptrdiff_t>(i) + 1, tips_.end());
    for (Path& path : shape_.paths(tips_[i], others)) {
      if (path.points.size() > 8) out.push_back({std::move(path)});
    }
  }
  return out;
}

void Judge::score(Pair& pair, double heaviest) const {
  const Vec2 a = pair.path.points.front(), b = pair.path.points.back();
  const double len = pair.path.length;
  pair.score = pair.path.weight / heaviest;
  const bool near_line = std::max(distance_to_mirror(a), distance_to_mirror(b)) < kOnLine * len;
  double strays = 0;
  for (const Vec2 p : pair.path.points) strays = std::max(strays, distance_to_mirror(p));
  if (mirror_.likeness > kSymmetric && near_line && strays < kAlongLine * len) {
    pair.on_mirror = true;
    // Every oval is symmetric about its short axis too.
    pair.score += kMirrorBonus * eyes_mirrored_ * std::min(1.0, pair.score / kLongEnough) *
                  std::min(1.0, (mirror_.likeness - kSymmetric) / (kFullySymmetric - kSymmetric));
  }
  std::array<double, 33> widths = widths_along(depth_, pair.path);
  double fin = caudal(widths);
  std::reverse(widths.begin(), widths.end());
  fin = std::max(fin, caudal(widths));
  pair.score += kTailBonus * fin;
  pair.score += kEyeBonus * std::max(eye_nearness(a, len), eye_nearness(b, len));
}

// Where a figure has a body along its mirror line, the way from one claw to the other is none. A bow, symmetric across its
// bend, has no such body.
void Judge::penalise_twins(std::vector<Pair>& all, double heaviest) const {
  const auto spine = [&](const Pair& p) { return p.on_mirror && p.path.weight > kLongEnough * heaviest; };
  if (std::none_of(all.begin(), all.end(), spine)) return;
  for (Pair& p : all) {
    const Vec2 off = p.path.points.front() - mirror_.point;
    const Vec2 image = mirror_.point + mirror_.direction * (2 * dot(off, mirror_.direction)) - off;
    const auto apart = static_cast<double>(length(image - p.path.points.back()));
    if (apart < 3 * kOnLine * p.path.length) p.score -= kTwinPenalty * mirror_.likeness;
  }
}

// Log odds that the path's front is the head.
double Judge::head_log_odds(const Path& path, bool& tail_fin) const {
  const std::array<double, 33> forward = widths_along(depth_, path);
  std::array<double, 33> backward = forward;
  std::reverse(backward.begin(), backward.end());
  const double back_fin = caudal(forward), front_fin = caudal(backward);
  const double wider = std::log(std::max(front_half(forward), 1e-3) / std::max(front_half(backward), 1e-3));
  const double eyes = eye_nearness(path.points.front(), path.length) - eye_nearness(path.points.back(), path.length);
  const double odds = std::clamp(3 * wider, -2.0, 2.0) + 2.0 * (back_fin - front_fin) + 5.0 * eyes;
  tail_fin = (odds >= 0 ? back_fin : front_fin) > 0.25;
  return odds;
}

// The candidate that the user means.
std::optional<Vec2> Judge::told_end(const ToldHead& told) const {
  if (tips_.empty()) return std::nullopt;
  const auto worth = [&](Vec2 p) { return told.point ? -length(p - *told.point) : dot(p, told.direction); };
  return *std::max_element(tips_.begin(), tips_.end(), [&](Vec2 a, Vec2 b) { return worth(a) < worth(b); });
}

// The other corner of the fin that the path's back is a corner of.
std::optional<Vec2> Judge::twin_of(const Path& path, const std::vector<Pair>& all) const {
  for (const Pair& p : all) {
    Vec2 from = p.path.points.front(), to = p.path.points.back();
    if (length(to - path.points.front()) < length(from - path.points.front())) std::swap(from, to);
    const auto apart = static_cast<double>(length(to - path.points.back()));
    const bool same_head = static_cast<double>(length(from - path.points.front())) < 0.05 * path.length;
    const bool alike = std::abs(p.path.length - path.length) < kTwinLength * path.length;
    if (same_head && alike && apart > 0.06 * path.length && apart < kTwinApart * path.length) return to;
  }
  return std::nullopt;
}

FigureEnds Judge::judge(const std::optional<ToldHead>& told) {
  FigureEnds ends;
  ends.mirror_likeness = mirror_.likeness;
  std::vector<Pair> all = pairs();
  const std::optional<Vec2> head = told ? told_end(*told) : std::nullopt;
  if (head) {
    std::erase_if(all, [&](const Pair& p) {
      return std::min(length(p.path.points.front() - *head), length(p.path.points.back() - *head)) >
             3.0f / static_cast<float>(1e-3 + Shape::kGrid) * static_cast<float>(depth_.cols + depth_.rows);
    });
  }
  if (all.empty()) return ends;
  double heaviest = 1e-6;
  for (const Pair& p : all) heaviest = std::max(heaviest, p.path.weight);
  for (Pair& p : all) score(p, heaviest);
  penalise_twins(all, heaviest);
  std::sort(all.begin(), all.end(), [](const Pair& a, const Pair& b) { return a.score > b.score; });
  const Pair& best = all.front();
  double next = 0;  // the best pair that shares neither the place of its head nor of its tail
  for (const Pair& p : all) {
    const auto near = [&](Vec2 q) {
      return std::min(length(q - best.path.points.front()), length(q - best.path.points.back())) <
             static_cast<float>(0.25 * best.path.length);
    };
    if (!near(p.path.points.front()) || !near(p.path.points.back())) next = std::max(next, p.score);
  }
  ends.path = best.path, ends.on_mirror = best.on_mirror;
  ends.ends_confidence = std::clamp((best.score - next) / kClearLead, 0.0, 1.0);
  double odds = head_log_odds(ends.path, ends.has_tail_fin);
  bool turn = odds < 0;
  if (head) {
    const auto off = [&](Vec2 p) { return length(p - *head); };
    turn = off(best.path.points.back()) < off(best.path.points.front());
    ends.has_tail_fin = caudal(widths_along(depth_, best.path)) > 0.25;  // put right below when it turns
    odds = 50, ends.ends_confidence = 1;
  }
  if (turn) std::reverse(ends.path.points.begin(), ends.path.points.end());
  if (head) ends.has_tail_fin = caudal(widths_along(depth_, ends.path)) > 0.25;
  if (!ends.on_mirror) ends.tail_twin = twin_of(ends.path, all);
  ends.head_confidence = std::tanh(0.5 * std::abs(odds));  // 2 p - 1: 0 where nothing tells
  return ends;
}

}  // namespace

FigureEnds find_figure_ends(const Shape& shape, const cv::Mat& mask, const std::vector<EyeSpot>& eyes,
                            const std::optional<ToldHead>& told) {
  return Judge(shape, mask, eyes).judge(told);
}

}  // namespace nt
