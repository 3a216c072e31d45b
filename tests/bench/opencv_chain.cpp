// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/opencv_chain.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nt::test {
namespace {

constexpr int kHarmonics = 5;  // S
constexpr float kPi = 3.14159265f;

float distance(cv::Point2f a, cv::Point2f b) { return std::hypot(a.x - b.x, a.y - b.y); }
Vec2 to_vec(cv::Point2f p) { return {p.x, p.y}; }

// The contour's points from index `from` to `to`, forwards or backwards round.
std::vector<std::size_t> walk(std::size_t from, std::size_t to, std::size_t n, bool forwards) {
  std::vector<std::size_t> out;
  for (std::size_t i = from;; i = forwards ? (i + 1) % n : (i + n - 1) % n) {
    out.push_back(i);
    if (i == to) return out;
  }
}

struct Harmonics {
  float a0 = 0, a[kHarmonics + 1] = {}, b[kHarmonics + 1] = {};
};

// Eqs 3-6 for one coordinate v; t is the arc length at each point, t[n] = T.
Harmonics analyse(const std::vector<float>& v, const std::vector<float>& t) {
  Harmonics h;
  const std::size_t n = v.size();
  const float perimeter = t[n];
  float sum_dv = 0, sum_dt = 0;
  for (std::size_t p = 1; p <= n; ++p) {
    const float dv = v[p % n] - v[p - 1], dt = t[p] - t[p - 1];
    const float zeta = sum_dv - dv / dt * sum_dt;
    h.a0 += dv / (2 * dt) * (t[p] * t[p] - t[p - 1] * t[p - 1]) + zeta * dt;
    sum_dv += dv, sum_dt += dt;
    for (int k = 1; k <= kHarmonics; ++k) {
      const float w = 2 * static_cast<float>(k) * kPi / perimeter;
      h.a[k] += dv / dt * (std::cos(w * t[p]) - std::cos(w * t[p - 1]));
      h.b[k] += dv / dt * (std::sin(w * t[p]) - std::sin(w * t[p - 1]));
    }
  }
  h.a0 = h.a0 / perimeter + v[0];
  for (int k = 1; k <= kHarmonics; ++k) {
    const float scale = perimeter / (2 * static_cast<float>(k * k) * kPi * kPi);
    h.a[k] *= scale, h.b[k] *= scale;
  }
  return h;
}

float reconstruct(const Harmonics& h, float t, float perimeter) {
  float v = h.a0;
  for (int k = 1; k <= kHarmonics; ++k) {
    const float w = 2 * static_cast<float>(k) * kPi * t / perimeter;
    v += h.a[k] * std::cos(w) + h.b[k] * std::sin(w);
  }
  return v;
}

// `count` points, uniform by arc length along `line`, without its first point and its last.
void sample(const std::vector<cv::Point2f>& line, int count, Vec2* out) {
  std::vector<float> at(line.size(), 0.0f);
  for (std::size_t i = 1; i < line.size(); ++i) at[i] = at[i - 1] + distance(line[i], line[i - 1]);
  std::size_t i = 1;
  for (int k = 1; k <= count; ++k) {
    const float want = at.back() * static_cast<float>(k) / static_cast<float>(count + 1);
    while (i + 1 < line.size() && at[i] < want) ++i;
    const float step = at[i] - at[i - 1];
    const float f = step > 0 ? (want - at[i - 1]) / step : 0.0f;
    out[k - 1] = to_vec(line[i - 1] + (line[i] - line[i - 1]) * f);
  }
}

// [F] section 4.4: R between P and Q with the largest angle PQR, then the point between Q and R farthest from line QR.
cv::Point2f junction(const std::vector<cv::Point2f>& contour, const std::vector<std::size_t>& from_p_to_q) {
  const cv::Point2f p = contour[from_p_to_q.front()], q = contour[from_p_to_q.back()];
  std::size_t r = 0;
  float widest = -1;
  for (std::size_t i = 0; i + 1 < from_p_to_q.size(); ++i) {
    const cv::Point2f u = p - q, v = contour[from_p_to_q[i]] - q;
    const float angle = std::abs(std::atan2(u.x * v.y - u.y * v.x, u.dot(v)));
    if (angle > widest) widest = angle, r = i;
  }
  const cv::Point2f qr = contour[from_p_to_q[r]] - q;
  cv::Point2f best = q;
  float farthest = -1;
  for (std::size_t i = r; i < from_p_to_q.size(); ++i) {
    const cv::Point2f v = contour[from_p_to_q[i]] - q;
    const float d = std::abs(qr.x * v.y - qr.y * v.x);
    if (d > farthest) farthest = d, best = contour[from_p_to_q[i]];
  }
  return best;
}

}  // namespace

OpenCvChain::OpenCvChain(OpenCvModel model) : element_(cv::getStructuringElement(cv::MORPH_RECT, {3, 3})) {
  if (model == OpenCvModel::mog2) background_ = cv::createBackgroundSubtractorMOG2(500, 16, false);
  else background_ = cv::createBackgroundSubtractorKNN(500, 400, false);
}

bool OpenCvChain::step(const cv::Mat& luma, NowNs now, StageTimes& times) {
  StageClock clock(now, times);
  background_->apply(luma, foreground_);
  clock.lap(Stage::background);
  cv::morphologyEx(foreground_, cleaned_, cv::MORPH_OPEN, element_);
  clock.lap(Stage::clean);
  cv::connectedComponentsWithStats(cleaned_, labels_, stats_, centroids_, 8);
  clock.lap(Stage::components);
  cv::Rect box;
  int label = 0;
  if (!largest_component(box, label)) return false;
  clock.lap(Stage::target);
  remove_shadow(luma, box, label);
  clock.lap(Stage::refine);
  if (!find_contour(box)) return false;
  clock.lap(Stage::outline);
  find_landmarks(box);
  clock.lap(Stage::landmarks);
  find_motion();
  clock.lap(Stage::motion);
  return true;
}

bool OpenCvChain::largest_component(cv::Rect& box, int& label) const {
  int area = cleaned_.rows * cleaned_.cols / 4000;  // as CaptureSettings::min_area_px
  label = 0;
  for (int i = 1; i < stats_.rows; ++i) {
    if (stats_.at<int>(i, cv::CC_STAT_AREA) <= area) continue;
    area = stats_.at<int>(i, cv::CC_STAT_AREA);
    label = i;
  }
  if (label == 0) return false;
  box = {stats_.at<int>(label, cv::CC_STAT_LEFT), stats_.at<int>(label, cv::CC_STAT_TOP),
         stats_.at<int>(label, cv::CC_STAT_WIDTH), stats_.at<int>(label, cv::CC_STAT_HEIGHT)};
  return true;
}

// Otsu splits the box into two classes; the fish is the one that the component's pixels are in. A cut that takes more
// than half of the component has no shadow to take.
void OpenCvChain::remove_shadow(const cv::Mat& luma, const cv::Rect& box, int label) {
  fish_ = labels_(box) == label;
  cv::threshold(luma(box), otsu_, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const bool bright = cv::mean(luma(box), fish_)[0] > cv::mean(luma(box), ~fish_)[0];
  const cv::Mat cut = fish_ & (bright ? otsu_ : ~otsu_);
  if (2 * cv::countNonZero(cut) > cv::countNonZero(fish_)) fish_ = cut;
}

bool OpenCvChain::find_contour(const cv::Rect& box) {
  cv::findContours(fish_, contours_, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, box.tl());
  const auto longest = std::max_element(contours_.begin(), contours_.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (longest == contours_.end() || longest->size() < 16) return false;
  contour_.assign(longest->begin(), longest->end());
  return true;
}

void OpenCvChain::find_landmarks(const cv::Rect& box) {
  principal_axis(box);
  find_ends();
  smooth_contour();
  find_axis();
  find_fins();
}

void OpenCvChain::principal_axis(const cv::Rect& box) {
  cv::findNonZero(fish_, pixels_);
  const cv::Mat points(static_cast<int>(pixels_.size()), 2, CV_32S, pixels_.data());
  cv::Mat samples;
  points.convertTo(samples, CV_32F);
  const cv::PCA pca(samples, cv::noArray(), cv::PCA::DATA_AS_ROW);
  barycentre_ = cv::Point2f(pca.mean.at<float>(0), pca.mean.at<float>(1)) + cv::Point2f(box.tl());
  Vec2 dir{pca.eigenvectors.at<float>(0, 0), pca.eigenvectors.at<float>(0, 1)};
  if (dot(dir, pose_.dir) < 0) dir = dir * -1.0f;
  pose_.dir = dir;
}

// [F] section 4.2, with dir as the calibration against a swap.
void OpenCvChain::find_ends() {
  const std::size_t n = contour_.size();
  const auto farthest = [&](std::size_t first, std::size_t count) {
    std::size_t best = first % n;
    for (std::size_t i = first; i < first + count; ++i) {
      if (distance(contour_[i % n], barycentre_) > distance(contour_[best], barycentre_)) best = i % n;
    }
    return best;
  };
  tail_ = farthest(0, n);
  head_ = farthest(tail_ + n / 4, n / 2);
  if (dot(to_vec(contour_[head_] - contour_[tail_]), pose_.dir) < 0) std::swap(head_, tail_);
  pose_.head = to_vec(contour_[head_]);
  pose_.tail = to_vec(contour_[tail_]);
}

void OpenCvChain::smooth_contour() {
  const std::size_t n = contour_.size();
  std::vector<float> x(n), y(n), t(n + 1, 0.0f);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = contour_[i].x, y[i] = contour_[i].y;
    t[i + 1] = t[i] + distance(contour_[(i + 1) % n], contour_[i]);
  }
  const Harmonics hx = analyse(x, t), hy = analyse(y, t);
  smooth_.resize(n);
  for (std::size_t i = 0; i < n; ++i) smooth_[i] = {reconstruct(hx, t[i], t[n]), reconstruct(hy, t[i], t[n])};
}

// Eq 1 on the smooth contour, then [F]'s new centre and the samples on both sides of it.
void OpenCvChain::find_axis() {
  const std::size_t n = smooth_.size();
  std::vector<std::size_t> p = walk(head_, tail_, n, true), q = walk(head_, tail_, n, false);
  if (p.size() > q.size()) std::swap(p, q);
  const double ratio = static_cast<double>(q.size()) / static_cast<double>(p.size());
  axis_.clear();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto j = static_cast<std::size_t>(ratio * static_cast<double>(i));
    axis_.push_back((smooth_[p[i]] + smooth_[q[j]]) / 2);
  }
  const auto centre = std::min_element(axis_.begin(), axis_.end(), [&](cv::Point2f a, cv::Point2f b) {
    return distance(a, barycentre_) < distance(b, barycentre_);
  });
  pose_.centre = to_vec(*centre);
  std::vector<cv::Point2f> up(axis_.begin(), centre + 1);
  std::reverse(up.begin(), up.end());
  sample(up, pose_.u_num, pose_.up_axis);
  sample({centre, axis_.end()}, pose_.l_num, pose_.low_axis);
  pose_.axis_len = static_cast<float>(cv::arcLength(axis_, false));
}

void OpenCvChain::find_fins() {
  std::vector<Vec2> line{pose_.head, pose_.centre, pose_.tail};
  line.insert(line.end(), pose_.up_axis, pose_.up_axis + pose_.u_num);
  line.insert(line.end(), pose_.low_axis, pose_.low_axis + pose_.l_num);
  for (const bool forwards : {true, false}) {
    const std::vector<std::size_t> side = walk(head_, tail_, contour_.size(), forwards);
    std::size_t tip = 0;
    float farthest = -1;
    for (std::size_t i = 0; i < side.size(); ++i) {
      float nearest = 1e9f;
      for (const Vec2 a : line) nearest = std::min(nearest, length_sq(to_vec(contour_[side[i]]) - a));
      if (nearest > farthest) farthest = nearest, tip = i;
    }
    const auto at = side.begin() + static_cast<std::ptrdiff_t>(tip);
    const std::vector<std::size_t> top(side.begin(), at + 1);
    std::vector<std::size_t> bottom(at, side.end());
    std::reverse(bottom.begin(), bottom.end());
    const Vec2 fin = to_vec(contour_[side[tip]]);
    const bool right = dot(fin - pose_.centre, right_of(pose_.dir)) > 0;
    (right ? pose_.r_fin : pose_.l_fin) = fin;
    (right ? pose_.jun_tr : pose_.jun_tl) = to_vec(junction(contour_, top));
    (right ? pose_.jun_br : pose_.jun_bl) = to_vec(junction(contour_, bottom));
  }
}

// Eq 14: the angle of each bone in the fish-local frame.
void OpenCvChain::find_motion() {
  angles_.clear();
  const auto bone = [&](Vec2 from, Vec2 to) {
    const Vec2 d = to - from;
    angles_.push_back(std::atan2(dot(d, pose_.dir), dot(d, right_of(pose_.dir))));
  };
  Vec2 last = pose_.centre;
  for (int i = 0; i < pose_.u_num; ++i) bone(last, pose_.up_axis[i]), last = pose_.up_axis[i];
  bone(last, pose_.head);
  last = pose_.centre;
  for (int i = 0; i < pose_.l_num; ++i) bone(last, pose_.low_axis[i]), last = pose_.low_axis[i];
  bone(last, pose_.tail);
  bone(pose_.centre, pose_.l_fin);
  bone(pose_.centre, pose_.r_fin);
}

}  // namespace nt::test
