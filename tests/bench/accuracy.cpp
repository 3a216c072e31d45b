// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/motion/order.h"
#include "tests/support/block.h"

namespace nt::test {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

double distance_to_segment_sq(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 ab = b - a;
  const float n = length_sq(ab);
  const float t = n > 0 ? std::clamp(dot(p - a, ab) / n, 0.0f, 1.0f) : 0.0f;
  return length_sq(p - (a + ab * t));
}

double distance_sq(Vec2 p, const std::vector<Vec2>& line) {
  double best = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    best = std::min(best, distance_to_segment_sq(p, line[i], line[i + 1]));
  }
  return best;
}

std::vector<Vec2> axis_of(const FishPose& pose) {
  std::vector<Vec2> axis{pose.head};
  for (int i = pose.u_num - 1; i >= 0; --i) axis.push_back(pose.up_axis[i]);
  axis.push_back(pose.centre);
  for (int i = 0; i < pose.l_num; ++i) axis.push_back(pose.low_axis[i]);
  axis.push_back(pose.tail);
  return axis;
}

void score_fin(float true_confidence, float our_confidence, Vec2 true_tip, Vec2 our_tip, float body, Accuracy& out) {
  const bool open = true_confidence >= 1.0f;
  const bool seen = our_confidence > 0.0f;
  out.fins_open += open;
  out.fins_claimed += seen;
  // A fin between folded and open may be seen or not: only a fin that is wholly folded makes a sighting false.
  out.fins_true += seen && true_confidence > 0.0f;
  if (!open || !seen) return;
  ++out.fins_found;
  out.fin_tip.push_back(100.0f * length(our_tip - true_tip) / body);
}

void score_pose(const FishPose& ours, const TankTruth& truth, Accuracy& out) {
  const FishPose& real = truth.pose;
  const float per_cent = 100.0f / real.axis_len;
  out.head.push_back(length(ours.head - real.head) * per_cent);
  out.tail.push_back(length(ours.tail - real.tail) * per_cent);
  out.centre.push_back(length(ours.centre - real.centre) * per_cent);
  out.midline.push_back(static_cast<float>(midline_rms_px(ours, truth.midline)) * per_cent);
  out.direction.push_back(
      static_cast<float>(kDegrees * std::abs(std::atan2(cross(real.dir, ours.dir), dot(real.dir, ours.dir)))));
  score_fin(real.confidence.l_fin, ours.confidence.l_fin, real.l_fin, ours.l_fin, real.axis_len, out);
  score_fin(real.confidence.r_fin, ours.confidence.r_fin, real.r_fin, ours.r_fin, real.axis_len, out);
}

// A pose that is not the fish's: nobody is there, it is another's, or that of a heap of two.
std::string what_is_false(const FishPose& ours, const TankTruth& truth, Accuracy& out) {
  constexpr float kHeap = 0.05f;  // body lengths of midline rms, where another fish covers ours
  if (!ours.ok()) return "";
  const float off = length(ours.centre - truth.pose.centre);
  for (const FishPose& other : truth.others) {
    if (length(ours.centre - other.centre) < off && off > 0.5f * truth.pose.axis_len) {
      ++out.wrong_fish;
      return "false pose: another fish";
    }
  }
  if (!truth.visible) return "false pose: no fish wholly visible";
  if (off > 0.5f * truth.pose.axis_len) return "false pose: not at the fish";
  const bool heap = truth.covered && midline_rms_px(ours, truth.midline) > kHeap * truth.pose.axis_len;
  return heap ? "false pose: two fish taken for one" : "";
}

int confidence_bin(float confidence) {
  if (confidence >= 0.99f) return Accuracy::kBins - 1;
  return std::clamp(static_cast<int>(10.0f * confidence) - 5, 0, Accuracy::kBins - 2);
}

// Of a closed ring the ends lie together: both count.
bool wrong_end(const FishPose& ours, const FishPose& real) {
  return length(ours.head - real.head) + length(ours.tail - real.tail) >
         length(ours.head - real.tail) + length(ours.tail - real.head);
}

class Scorer {
 public:
  Scorer(const OddFrame& odd, Accuracy& out) : odd_(odd), out_(out) {}

  // Every frame, scored or not.
  void follow(const Capture& capture) {
    if (!capture.pose().ok()) return;
    steps_.push_back(order_.add(capture.order()));
    wrong_.push_back(kNotScored);
  }
  void look_back() {
    order_.trace_back(steps_);
    for (std::size_t i = 0; i < steps_.size(); ++i)
      out_.wrong_after += wrong_[i] != kNotScored && wrong_[i] != steps_[i];
  }

  void score(const FishPose& ours, const TankTruth& truth, int64_t frame) {
    const bool visible = truth.visible && !truth.covered;
    ++out_.scored;
    out_.visible += visible;
    const std::string wrong = what_is_false(ours, truth, out_);
    const bool right = ours.ok() && wrong.empty();
    out_.false_poses += !wrong.empty();
    if (!wrong.empty()) report(frame, wrong);
    if (right) waited_ = 0;
    else if (visible) out_.longest_wait = std::max(out_.longest_wait, ++waited_);
    if (!visible) return;
    if (!ours.ok()) report(frame, std::string("missed: ") + to_string(ours.status));
    if (!right) return;
    ++out_.posed;
    const int bin = confidence_bin(ours.confidence.head);
    ++out_.sure_poses[bin];
    wrong_.back() = wrong_end(ours, truth.pose);
    if (wrong_.back() == 1) {
      ++out_.wrong_end, ++out_.sure_wrong[bin];
      report(frame, "wrong end");
    }
    score_pose(ours, truth, out_);
  }

 private:
  void report(int64_t frame, const std::string& what) const {
    if (odd_) odd_(frame, what);
  }
  const OddFrame& odd_;
  Accuracy& out_;
  int waited_ = 0;
  static constexpr uint8_t kNotScored = 2;
  OrderPass order_;
  std::vector<uint8_t> steps_, wrong_;  // one entry a pose
};

}  // namespace

double midline_rms_px(const FishPose& pose, const std::vector<Vec2>& midline) {
  constexpr int kSteps = 8;  // per bone: under 1 % of the body length apart
  const std::vector<Vec2> axis = axis_of(pose);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
    for (int k = 0; k < kSteps; ++k, ++count) {
      sum += distance_sq(lerp(axis[i], axis[i + 1], static_cast<float>(k) / kSteps), midline);
    }
  }
  sum += distance_sq(axis.back(), midline);
  return std::sqrt(sum / (count + 1));
}

double quantile(std::vector<float> values, double q) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void Accuracy::add(const Accuracy& other) {
  scored += other.scored, visible += other.visible, posed += other.posed;
  wrong_end += other.wrong_end, wrong_after += other.wrong_after, false_poses += other.false_poses,
      wrong_fish += other.wrong_fish;
  longest_wait = std::max(longest_wait, other.longest_wait);
  fins_open += other.fins_open, fins_found += other.fins_found;
  fins_claimed += other.fins_claimed, fins_true += other.fins_true;
  for (int i = 0; i < kBins; ++i) sure_poses[i] += other.sure_poses[i], sure_wrong[i] += other.sure_wrong[i];
  const auto append = [](std::vector<float>& to, const std::vector<float>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(head, other.head), append(tail, other.tail), append(centre, other.centre);
  append(midline, other.midline), append(fin_tip, other.fin_tip), append(direction, other.direction);
}

Accuracy measure_accuracy(const AccuracyRun& run, const OddFrame& odd) {
  if (find_tank_scene(run.tank.scene) == nullptr) throw std::runtime_error("no tank scene is called " + run.tank.scene);
  Limits limits;
  limits.max_width = run.tank.width, limits.max_height = run.tank.height;
  const Block block(Capture::bytes_needed(limits, run.capture));
  Result<Capture*> made = Capture::create(block.span(), limits, run.capture, run.tank.width, run.tank.height);
  if (!made.ok()) throw std::runtime_error(made.status().message);
  Capture& capture = *made.value();

  Tank tank(run.tank);
  Accuracy out;
  out.scene = run.tank.scene;
  Scorer scorer(odd, out);
  for (int n = 0; n < run.frames; ++n) {
    Frame frame;
    frame.luma = tank.render_next();
    frame.sequence = static_cast<uint64_t>(n);
    frame.timestamp_ns = static_cast<int64_t>(1e9 * n / run.tank.fps);
    capture.step(frame);
    scorer.follow(capture);
    if (n >= run.warm_up) scorer.score(capture.pose(), tank.truth(), n);
  }
  scorer.look_back();
  return out;
}

}  // namespace nt::test
