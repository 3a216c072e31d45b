// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/real/real_video.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "app/export/pose_csv.h"
#include "app/session.h"

namespace nt::test {
namespace {

double distance(Vec2 a, cv::Point2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

double distance_to_line(Vec2 p, const std::vector<cv::Point2d>& line) {
  double best = 1e30;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const cv::Point2d a = line[i - 1], ab = line[i] - a, ap(p.x - a.x, p.y - a.y);
    const double u = std::clamp(ap.dot(ab) / std::max(ab.dot(ab), 1e-12), 0.0, 1.0);
    best = std::min(best, cv::norm(ap - ab * u));
  }
  return best;
}

FishPose in_source_pixels(FishPose pose, float scale) {
  for (Vec2* p : {&pose.centre, &pose.head, &pose.tail, &pose.l_fin, &pose.r_fin, &pose.jun_tl, &pose.jun_tr,
                  &pose.jun_bl, &pose.jun_br})
    *p = to_source(*p, scale);
  for (Vec2& p : pose.up_axis) p = to_source(p, scale);
  for (Vec2& p : pose.low_axis) p = to_source(p, scale);
  pose.axis_len *= scale;
  return pose;
}

// Root mean square distance of the pose's axis from the reference.
double midline_error(const FishPose& pose, const std::vector<cv::Point2d>& reference) {
  std::vector<Vec2> axis{pose.head};
  for (int i = pose.u_num - 1; i >= 0; --i) axis.push_back(pose.up_axis[i]);
  axis.push_back(pose.centre);
  for (int i = 0; i < pose.l_num; ++i) axis.push_back(pose.low_axis[i]);
  axis.push_back(pose.tail);
  double sum = 0;
  for (const Vec2 p : axis) sum += std::pow(distance_to_line(p, reference), 2);
  return std::sqrt(sum / static_cast<double>(axis.size()));
}

// Turns the references round so that each begins at the head: by a person in the first frame, then by continuity.
void order_references(std::vector<RealFrame>& frames, cv::Point2d head) {
  bool known = false;
  cv::Point2d tail;
  for (RealFrame& f : frames) {
    if (!f.reference.found) continue;
    std::vector<cv::Point2d>& line = f.reference.midline;
    const double kept = cv::norm(line.front() - head) + (known ? cv::norm(line.back() - tail) : 0.0);
    const double turned = cv::norm(line.back() - head) + (known ? cv::norm(line.front() - tail) : 0.0);
    if (turned < kept) std::reverse(line.begin(), line.end());
    head = line.front(), tail = line.back(), known = true;
  }
}

void score(RealFrame& f, double length) {
  const std::vector<cv::Point2d>& line = f.reference.midline;
  f.wrong_end = distance(f.pose.head, line.back()) < distance(f.pose.head, line.front());
  f.midline = 100 * midline_error(f.pose, line) / length;
  f.head = 100 * distance(f.pose.head, line.front()) / length;
  f.tail = 100 * distance(f.pose.tail, line.back()) / length;
}

double median_length(const std::vector<RealFrame>& frames) {
  std::vector<double> lengths;
  for (const RealFrame& f : frames)
    if (f.reference.found) lengths.push_back(f.reference.length);
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

std::vector<float> RealAccuracy::errors(double RealFrame::*which) const {
  std::vector<float> out;
  for (const RealFrame& f : all)
    if (f.*which >= 0) out.push_back(static_cast<float>(f.*which));
  return out;
}

double RealAccuracy::share_within(double RealFrame::*which, double limit) const {
  const std::vector<float> values = errors(which);
  const auto good = std::count_if(values.begin(), values.end(), [&](float v) { return v <= limit; });
  return values.empty() ? 0 : static_cast<double>(good) / static_cast<double>(values.size());
}

FinAgreement compare_fins(const RealAccuracy& clip, const std::string& labels, bool left) {
  std::ifstream file(std::string(NEONTETRA_LABELS) + "/" + labels);
  if (!file) throw std::runtime_error("no labels: " + labels);
  FinAgreement out;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::size_t first = 0, last = 0;
    char l = 0, r = 0;
    if (!(words >> first >> last >> l >> r)) continue;
    for (std::size_t i = first; i <= last && i < clip.all.size(); ++i) {
      const FishPose& pose = clip.all[i].pose;
      const bool ours = pose.ok() && (left ? pose.confidence.l_fin : pose.confidence.r_fin) > 0;
      const char label = left ? l : r;
      if (label == '1' && !ours) out.missed.push_back(static_cast<int>(i));
      if (label == '0' && ours) out.invented.push_back(static_cast<int>(i));
      out.doubtful += label == '?';
      out.seen += label == '1', out.seen_by_us += label == '1' && ours;
      out.unseen += label == '0', out.unseen_by_us += label == '0' && !ours;
    }
  }
  return out;
}

std::vector<cv::Mat> read_grey(const std::string& path) {
  cv::VideoCapture video(path);
  std::vector<cv::Mat> frames;
  for (cv::Mat picture; video.read(picture);) {
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    frames.push_back(grey);
  }
  return frames;
}

RealAccuracy measure_real(const RealClip& clip, const std::string& folder, std::optional<Size> work) {
  const std::string path = folder + "/" + clip.file;
  CaptureOptions options;
  options.camera.kind = CameraSpec::Kind::file;
  options.camera.path = path;
  options.work = work;
  Session session(options);
  RealAccuracy out;
  out.file = clip.file, out.background = session.capture().background_name();
  while (session.step()) {
    RealFrame f;
    f.index = static_cast<int>(session.frame_index());
    f.pose = in_source_pixels(session.capture().pose(), session.scale());
    out.all.push_back(f);
  }
  const std::vector<cv::Mat> frames = read_grey(path);
  cv::Mat ground;
  if (clip.reference.ground >= 0) ground = clip_quantile(frames, clip.reference.ground);
  for (RealFrame& f : out.all) {
    if (f.index < clip.first_frame || f.index >= static_cast<int>(frames.size())) continue;
    f.reference = reference_midline(frames[static_cast<std::size_t>(f.index)], ground, clip.reference);
  }
  order_references(out.all, clip.head_in_first);
  out.length = median_length(out.all);
  for (RealFrame& f : out.all) {
    out.frames += f.reference.found;
    out.false_poses += f.pose.ok() && !f.reference.found;
    if (!f.reference.found || !f.pose.ok()) continue;
    score(f, out.length);
    ++out.posed;
    out.wrong_end += f.wrong_end;
  }
  return out;
}

}  // namespace nt::test
