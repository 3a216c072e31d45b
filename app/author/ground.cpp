// SPDX-License-Identifier: Apache-2.0
#include "app/author/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace nt {
namespace {

constexpr int kRim = 12;                // the ground is fitted to 1/kRim of the picture along its edges
constexpr int kFits = 4;                // rounds; each drops what is far from the last fit (the figure, a hand)
constexpr double kFarFromGround = 2.0;  // standard deviations
constexpr double kLeastDifference = 22, kMostDifference = 70;  // grey levels: paper's grain, a pale pencil
// Paper: bright enough to be lit, and nearly without colour.
constexpr double kPaperLuma = 90, kPaperChroma = 28;
constexpr double kWhite = 250;

std::array<double, 6> terms(int x, int y, cv::Size size) {
  const double u = 2.0 * x / size.width - 1, v = 2.0 * y / size.height - 1;
  return {1, u, v, u * u, u * v, v * v};
}

// The ground's colour everywhere, 32FC3.
cv::Mat fitted_ground(const cv::Mat& rgb) {
  std::vector<cv::Point> rim;
  const int rx = std::max(2, rgb.cols / kRim), ry = std::max(2, rgb.rows / kRim), step = std::max(1, rgb.cols / 200);
  for (int y = 0; y < rgb.rows; y += step) {
    for (int x = 0; x < rgb.cols; x += step) {
      if (x < rx || y < ry || x >= rgb.cols - rx || y >= rgb.rows - ry) rim.emplace_back(x, y);
    }
  }
  cv::Mat a(static_cast<int>(rim.size()), 6, CV_64F), b(a.rows, 3, CV_64F), weights(a.rows, 1, CV_64F, cv::Scalar(1)),
      fit;
  for (int i = 0; i < a.rows; ++i) {
    const auto t = terms(rim[static_cast<std::size_t>(i)].x, rim[static_cast<std::size_t>(i)].y, rgb.size());
    for (int k = 0; k < 6; ++k) a.at<double>(i, k) = t[static_cast<std::size_t>(k)];
    const cv::Vec3f c = rgb.at<cv::Vec3f>(rim[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 3; ++k) b.at<double>(i, k) = static_cast<double>(c[k]);
  }
  for (int round = 0; round < kFits; ++round) {
    cv::Mat wa = a.clone(), wb = b.clone();
    for (int i = 0; i < a.rows; ++i) wa.row(i) *= weights.at<double>(i), wb.row(i) *= weights.at<double>(i);
    cv::solve(wa, wb, fit, cv::DECOMP_SVD);
    const cv::Mat residual = a * fit - b;
    double sum = 0, count = 1e-9;
    for (int i = 0; i < a.rows; ++i) {
      if (weights.at<double>(i) > 0) sum += std::pow(cv::norm(residual.row(i)), 2), count += 1;
    }
    const double limit = kFarFromGround * std::max(2.0, std::sqrt(sum / count));
    for (int i = 0; i < a.rows; ++i) weights.at<double>(i) = cv::norm(residual.row(i)) < limit ? 1 : 0;
  }
  cv::Mat ground(rgb.size(), CV_32FC3);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      const auto t = terms(x, y, rgb.size());
      cv::Vec3f& c = ground.at<cv::Vec3f>(y, x);
      for (int k = 0; k < 3; ++k) {
        double v = 0;
        for (int j = 0; j < 6; ++j) v += t[static_cast<std::size_t>(j)] * fit.at<double>(j, k);
        c[k] = static_cast<float>(std::clamp(v, 1.0, 255.0));
      }
    }
  }
  return ground;
}

cv::Mat edges_of(const cv::Mat& rgba) {
  cv::Mat grey, edges, unused;
  cv::cvtColor(rgba, grey, cv::COLOR_RGBA2GRAY);
  cv::GaussianBlur(grey, grey, {5, 5}, 1.2);
  const double otsu = cv::threshold(grey, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const double high = std::clamp(otsu * 0.5, 30.0, 120.0);
  cv::Canny(grey, edges, high * 0.4, high);
  return edges;
}

cv::Mat different(const cv::Mat& rgb, const cv::Mat& ground) {
  cv::Mat difference, planes[3], most, unused;
  cv::absdiff(rgb, ground, difference);
  cv::split(difference, planes);
  most = cv::max(planes[0], cv::max(planes[1], planes[2]));
  cv::GaussianBlur(most, most, {5, 5}, 1.2);
  most.convertTo(most, CV_8U);
  const double otsu = cv::threshold(most, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  return most > std::clamp(otsu, kLeastDifference, kMostDifference);
}

cv::Mat closed_and_filled(const cv::Mat& marks) {
  const int gap = std::max(2, std::max(marks.cols, marks.rows) / 120);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * gap + 1, 2 * gap + 1});
  cv::Mat padded;
  cv::copyMakeBorder(marks, padded, gap, gap, gap, gap, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(padded, padded, cv::MORPH_CLOSE, disc);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(padded, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat mask = cv::Mat::zeros(padded.size(), CV_8U);
  cv::drawContours(mask, contours, -1, 255, cv::FILLED);
  mask = mask(cv::Rect(gap, gap, marks.cols, marks.rows)).clone();
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  return mask;
}

bool is_paper(const cv::Mat& ground) {
  const cv::Scalar mean = cv::mean(ground);
  const double luma = (mean[0] + mean[1] + mean[2]) / 3;
  const double chroma = std::max({mean[0], mean[1], mean[2]}) - std::min({mean[0], mean[1], mean[2]});
  return luma > kPaperLuma && chroma < kPaperChroma;
}

}  // namespace

Ground remove_ground(const cv::Mat& rgba) {
  cv::Mat rgb;
  cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
  rgb.convertTo(rgb, CV_32FC3);
  const cv::Mat ground = fitted_ground(rgb);
  Ground out;
  out.paper = is_paper(ground);
  out.pixels = rgba;
  cv::Mat marks = edges_of(rgba) | different(rgb, ground);
  out.mask = closed_and_filled(marks);
  if (out.paper) {
    cv::Mat even, alpha;
    cv::divide(rgb, ground, even, kWhite);
    even.convertTo(even, CV_8UC3);
    cv::extractChannel(rgba, alpha, 3);
    cv::cvtColor(even, out.pixels, cv::COLOR_RGB2RGBA);
    cv::insertChannel(alpha, out.pixels, 3);
  }
  return out;
}

}  // namespace nt
