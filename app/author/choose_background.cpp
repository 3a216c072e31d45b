// SPDX-License-Identifier: Apache-2.0
#include "app/author/choose_background.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

constexpr std::size_t kKeep = 24;  // at least so many frames are kept of a long clip, at most twice as many
constexpr int kTestWidth = 320;    // averaging also takes sensor noise away
constexpr double kSmallestObject = 1.0 / 4000;  // of the frame, as in capture
constexpr double kFieldShare = 0.80;            // backlit and dark-field rigs measure 0.97-1.00
constexpr double kPresentShare = 0.90;
constexpr double kHeldShare = 0.30;     // never uncovered: trout 0.54, sunfish 0.74, fish in a PIV rig 0.90
constexpr double kCoveredShare = 0.15;  // a fish that swims off covers its first place for under a tenth of the clip

double median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<float> absolute(const cv::Mat& picture) {
  return std::vector<float>(cv::Mat(cv::abs(picture)).reshape(1, 1));
}

cv::Mat small_float(const cv::Mat& frame) {
  cv::Mat out;
  const double scale = std::min(1.0, static_cast<double>(kTestWidth) / frame.cols);
  cv::resize(frame, out, {}, scale, scale, cv::INTER_AREA);
  out.convertTo(out, CV_32F);
  return out;
}

cv::Mat temporal_median(const std::vector<cv::Mat>& frames) {
  cv::Mat out(frames[0].size(), CV_32F);
  std::vector<float> column(frames.size());
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      for (std::size_t k = 0; k < frames.size(); ++k) column[k] = frames[k].at<float>(y, x);
      out.at<float>(y, x) = static_cast<float>(median(column));
    }
  }
  return out;
}

// A quadratic surface through the pixels that lie on it: least squares, outliers thrown out by their median deviation.
cv::Mat smooth_surface(const cv::Mat& picture) {
  const int pixels = static_cast<int>(picture.total());
  cv::Mat terms(pixels, 6, CV_32F);
  for (int i = 0; i < pixels; ++i) {
    const float x = static_cast<float>(i % picture.cols) / static_cast<float>(picture.cols) - 0.5f;
    const float y = static_cast<float>(i / picture.cols) / static_cast<float>(picture.rows) - 0.5f;
    const float row[6] = {1, x, y, x * x, x * y, y * y};
    std::copy(row, row + 6, terms.ptr<float>(i));
  }
  const cv::Mat values = picture.clone().reshape(1, pixels);
  cv::Mat surface(pixels, 1, CV_32F, cv::Scalar(median(std::vector<float>(values))));
  for (int round = 0; round < 6; ++round) {
    const cv::Mat residual = cv::abs(values - surface);
    const double reach = std::max(3.0, 2.5 * 1.4826 * median(std::vector<float>(residual)));
    cv::Mat weight;
    cv::Mat(residual <= reach).convertTo(weight, CV_32F, 1.0 / 255);
    const cv::Mat weighted = terms.mul(cv::repeat(weight, 1, 6));
    cv::Mat coefficients;
    cv::solve(weighted.t() * terms, weighted.t() * values, coefficients, cv::DECOMP_SVD);
    surface = terms * coefficients;
  }
  return surface.reshape(1, picture.rows);
}

// The largest connected part of `mask` that keeps clear of the frame's edge (a dish's rim, a dark corner do not);
// empty when none is large enough.
cv::Mat largest_object(const cv::Mat& mask) {
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids);
  int best = 0, best_area = static_cast<int>(std::ceil(kSmallestObject * static_cast<double>(mask.total())));
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const bool at_edge = box.x == 0 || box.y == 0 || box.br().x == mask.cols || box.br().y == mask.rows;
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (!at_edge && area >= best_area) best = i, best_area = area;
  }
  return best == 0 ? cv::Mat() : cv::Mat(labels == best);
}

double share(const cv::Mat& part, const cv::Mat& of) {
  return static_cast<double>(cv::countNonZero(part & of)) / std::max(1, cv::countNonZero(of));
}

int percent(double part) { return static_cast<int>(std::lround(100 * part)); }

struct FieldTest {
  bool passed = false;
  bool bright = false;
  double field = 0;    // share of the pixels outside the fish's first place that lie on the surface
  double present = 0;  // share of the frames that show an object
  double held = 0;     // share of its first place that it never uncovers
};

FieldTest test_even_field(const std::vector<cv::Mat>& frames, const cv::Mat& typical, const cv::Mat& surface) {
  const double reach = std::max(24.0, 5 * 1.4826 * median(absolute(typical - surface)));
  FieldTest test;
  test.bright = cv::mean(surface)[0] > 127;
  cv::Mat first, held;
  for (const cv::Mat& frame : frames) {
    const cv::Mat stands_out = cv::abs(frame - surface) > reach;
    const cv::Mat object = largest_object(stands_out);
    if (object.empty()) continue;
    test.present += 1.0 / static_cast<double>(frames.size());
    if (first.empty()) first = object, held = object.clone();
    held &= stands_out;
  }
  if (first.empty()) return test;
  test.field = share(cv::abs(typical - surface) <= reach, ~first);
  test.held = share(held, first);
  test.passed = test.field >= kFieldShare && test.present >= kPresentShare && test.held >= kHeldShare;
  return test;
}

// Share of the clip for which the first frame's fish covers its place; 0 when the first frame shows no fish that the
// median lacks. Of the two the fish is in the one that leaves the smooth surface farther: a fish that enters later and
// rests is in the median instead.
double first_place_covered(const std::vector<cv::Mat>& frames, const cv::Mat& typical, const cv::Mat& surface) {
  std::vector<float> change;
  for (const cv::Mat& frame : frames) change.push_back(static_cast<float>(median(absolute(frame - typical))));
  const double reach = std::max(16.0, 6 * 1.4826 * median(change));
  const cv::Mat first = largest_object(cv::abs(frames[0] - typical) > reach);
  if (first.empty()) return 0;
  if (cv::mean(cv::abs(frames[0] - surface), first)[0] < cv::mean(cv::abs(typical - surface), first)[0]) return 0;
  double covered = 0;
  for (const cv::Mat& frame : frames) covered += share(cv::abs(frame - typical) > reach, first);
  return covered / static_cast<double>(frames.size());
}

cv::Mat view_of(const Frame& frame) {
  const LumaView& luma = frame.luma;
  return cv::Mat(luma.height, luma.width, CV_8U, const_cast<uint8_t*>(luma.data),
                 static_cast<std::size_t>(luma.stride));
}

// What `look` makes of 24-48 frames spread evenly over the first kLookFrames; the camera is rewound.
template <class Look>
std::vector<cv::Mat> spread(Camera& camera, Look look) {
  std::vector<cv::Mat> kept;
  if (!camera.rewind()) return kept;
  int64_t step = 1;
  for (int64_t n = 0; n < kLookFrames; ++n) {
    const std::optional<Frame> frame = camera.next();
    if (!frame) break;
    if (n % step != 0) continue;
    kept.push_back(look(*frame));
    if (kept.size() < 2 * kKeep) continue;
    for (std::size_t i = 0; i < kKeep; ++i) kept[i] = kept[2 * i];
    kept.resize(kKeep);
    step *= 2;
  }
  camera.rewind();
  return kept;
}

}  // namespace

std::vector<cv::Mat> spread_frames(Camera& camera) {
  return spread(camera, [](const Frame& frame) { return view_of(frame).clone(); });
}

std::vector<cv::Mat> spread_small(Camera& camera) {
  return spread(camera, [](const Frame& frame) { return small_float(view_of(frame)); });
}

std::vector<cv::Mat> spread_pictures(Camera& camera) {
  return spread(camera, [&camera](const Frame&) {
    const Picture picture = camera.picture();
    const int type = picture.format == PixelFormat::luma8 ? CV_8UC1 : CV_8UC3;
    return cv::Mat(picture.height, picture.width, type, const_cast<uint8_t*>(picture.pixels),
                   static_cast<std::size_t>(picture.stride))
        .clone();
  });
}

BackgroundChoice choose_background(const std::vector<cv::Mat>& small) {
  if (small.size() < 3) return {BackgroundKind::vibe, "there is nothing to look ahead at"};
  const cv::Mat typical = temporal_median(small);

  const cv::Mat surface = smooth_surface(typical);
  std::ostringstream why;
  const FieldTest test = test_even_field(small, typical, surface);
  if (test.passed) {
    why << percent(test.field) << " % of pixels lie on a smooth " << (test.bright ? "bright" : "dark")
        << " field; the fish never uncovers " << percent(test.held) << " % of its first place";
    return {BackgroundKind::backlit, why.str()};
  }
  const double covered = first_place_covered(small, typical, surface);
  if (covered >= kCoveredShare) {
    why << "the fish covers its first place for " << percent(covered) << " % of the clip, then leaves it";
    return {BackgroundKind::still, why.str()};
  }
  why << (covered > 0 ? "the fish soon leaves its first place" : "no fish stays in its first place") << ": covered for "
      << percent(covered) << " % of the clip";
  return {BackgroundKind::vibe, why.str()};
}

}  // namespace nt
