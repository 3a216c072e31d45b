// SPDX-License-Identifier: Apache-2.0
#include "app/author/figure.h"

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/author/ground.h"
#include "platform/camera.h"
#include "platform/codecs.h"

namespace nt {
namespace {

constexpr int kLeastPicture = 16;       // pixels a side; nothing can be cut from less
constexpr int kOpaque = 128;            // alpha from which a pixel belongs to the figure
constexpr double kLeastFigure = 0.004;  // share of the picture; less is a speck
// The mesh reaches this far past the opaque edge, so that the edge's own soft pixels are drawn.
constexpr int kSoftEdge = 2;

cv::Mat read_rgba(const std::string& path) {
  if (!std::ifstream(path))
    throw UserError("cannot read the picture " + path + ": no such file, or no right to read it");
  cv::Mat image;
  try {
    image = codecs().read_picture(path, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw UserError(path + " is not a picture that can be read; use PNG or JPEG");
  if (image.depth() != CV_8U) {
    image.convertTo(image, CV_8U, image.depth() == CV_16U ? 1.0 / 257 : 255.0);
  }
  cv::Mat rgba;
  if (image.channels() == 1) cv::cvtColor(image, rgba, cv::COLOR_GRAY2RGBA);
  if (image.channels() == 3) cv::cvtColor(image, rgba, cv::COLOR_BGR2RGBA);
  if (image.channels() == 4) cv::cvtColor(image, rgba, cv::COLOR_BGRA2RGBA);
  if (rgba.empty()) throw UserError(path + " has an unusual number of channels; save it as an RGB or RGBA PNG");
  if (rgba.cols < kLeastPicture || rgba.rows < kLeastPicture) {
    throw UserError(path + " is too small (" + std::to_string(rgba.cols) + "x" + std::to_string(rgba.rows) +
                    "); a character needs at least 16x16 pixels");
  }
  return rgba;
}

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

// Scales colours weighted by alpha, so that transparent pixels' colours do not bleed in.
cv::Mat resized(const cv::Mat& rgba, double scale) {
  cv::Mat premultiplied, alpha;
  rgba.convertTo(premultiplied, CV_32FC4);
  std::vector<cv::Mat> planes;
  cv::split(premultiplied, planes);
  for (int i = 0; i < 3; ++i)
    planes[static_cast<std::size_t>(i)] = planes[static_cast<std::size_t>(i)].mul(planes[3], 1.0 / 255);
  cv::merge(planes, premultiplied);
  const int how = scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR;
  cv::resize(premultiplied, premultiplied, {}, scale, scale, how);
  cv::split(premultiplied, planes);
  for (int i = 0; i < 3; ++i) {
    cv::Mat& plane = planes[static_cast<std::size_t>(i)];
    cv::divide(plane * 255.0, cv::max(planes[3], 1e-3), plane);
  }
  cv::Mat out;
  cv::merge(planes, out);
  out.convertTo(out, CV_8UC4);
  return out;
}

bool has_transparency(const cv::Mat& alpha) {
  return cv::countNonZero(alpha < kOpaque) > static_cast<int>(alpha.total() / 100);
}

cv::Mat opaque_pixels(const cv::Mat& rgba) {
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  return alpha >= kOpaque;
}

// The largest outline; `count` says how many are not specks.
std::vector<cv::Point> largest_outline(const cv::Mat& mask, int& count) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  count = 0;
  std::vector<cv::Point> best;
  double best_area = kLeastFigure * static_cast<double>(mask.total());
  for (auto& c : contours) {
    const double area = cv::contourArea(c);
    if (area < kLeastFigure * static_cast<double>(mask.total())) continue;
    ++count;
    if (area >= best_area) best_area = area, best = c;
  }
  return best;
}

// Gives every see-through pixel the colour of the nearest opaque one, so that filtering at the edge draws no dark fringe.
void bleed(cv::Mat& rgba) {
  cv::Mat alpha, distance, labels;
  cv::extractChannel(rgba, alpha, 3);
  const cv::Mat see_through = alpha < kOpaque;
  if (cv::countNonZero(see_through) == static_cast<int>(alpha.total())) return;
  cv::distanceTransform(see_through, distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec4b> colour(alpha.total() + 1);
  for (int y = 0; y < rgba.rows; ++y) {
    for (int x = 0; x < rgba.cols; ++x) {
      if (see_through.at<uchar>(y, x) == 0)
        colour[static_cast<std::size_t>(labels.at<int>(y, x))] = rgba.at<cv::Vec4b>(y, x);
    }
  }
  for (int y = 0; y < rgba.rows; ++y) {
    for (int x = 0; x < rgba.cols; ++x) {
      if (see_through.at<uchar>(y, x) == 0) continue;
      cv::Vec4b& pixel = rgba.at<cv::Vec4b>(y, x);
      const cv::Vec4b& near = colour[static_cast<std::size_t>(labels.at<int>(y, x))];
      pixel = {near[0], near[1], near[2], pixel[3]};
    }
  }
}

// The figure's pixels at the size characters have, with a transparent margin around.
void crop_and_scale(const cv::Mat& rgba, const cv::Rect& box, Figure& figure) {
  const int side = std::max(box.width, box.height);
  double scale = 1;
  if (side > Figure::kMaxSide) scale = static_cast<double>(Figure::kMaxSide) / side;
  if (side < Figure::kMinSide) scale = static_cast<double>(Figure::kMinSide) / side;
  cv::Mat cropped = rgba(box).clone();
  if (scale != 1) cropped = resized(cropped, scale);
  constexpr int m = Figure::kMargin;
  cv::copyMakeBorder(cropped, figure.rgba, m, m, m, m, cv::BORDER_CONSTANT, cv::Scalar(0, 0, 0, 0));
  const auto s = static_cast<float>(scale);
  figure.picture_origin = Vec2{-static_cast<float>(box.x), -static_cast<float>(box.y)} * s + Vec2{m, m};
  figure.picture_size = Vec2{static_cast<float>(rgba.cols), static_cast<float>(rgba.rows)} * s;
}

}  // namespace

Figure load_figure(const std::string& path) {
  cv::Mat rgba = read_rgba(path);
  const int longer = std::max(rgba.cols, rgba.rows);
  // Edges and masks of a 20-megapixel photograph cost seconds and gain nothing.
  if (longer > 2 * Figure::kMaxSide) rgba = resized(rgba, 2.0 * Figure::kMaxSide / longer);
  Figure figure;
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  figure.from_alpha = has_transparency(alpha);
  cv::Mat found;
  if (figure.from_alpha) {
    found = opaque_pixels(rgba);
  } else {
    const Ground ground = remove_ground(rgba);
    found = ground.mask, rgba = ground.pixels, figure.paper = ground.paper;
  }
  std::vector<cv::Point> outline = largest_outline(found, figure.figures);
  const std::string nothing =
      path + ": no figure found; use a picture with transparency around the figure, or a plain background";
  if (outline.empty()) throw UserError(nothing);

  // Only the largest figure stays opaque, in the crop too.
  cv::Mat own = cv::Mat::zeros(rgba.size(), CV_8U);
  cv::drawContours(own, std::vector<std::vector<cv::Point>>{outline}, 0, 255, cv::FILLED);
  if (figure.from_alpha) cv::dilate(own, own, disc(kSoftEdge));
  cv::extractChannel(rgba, alpha, 3);
  cv::insertChannel(cv::min(alpha, own), rgba, 3);
  crop_and_scale(rgba, cv::boundingRect(own), figure);

  cv::extractChannel(figure.rgba, alpha, 3);
  cv::Mat mask = alpha >= kOpaque;
  if (figure.from_alpha) cv::dilate(mask, mask, disc(kSoftEdge));
  // Threads thinner than 5 px cannot be cut into triangles.
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc(2));
  int unused = 0;
  outline = largest_outline(mask, unused);
  if (outline.size() < 16) throw UserError(nothing);
  figure.mask = cv::Mat::zeros(mask.size(), CV_8U);
  cv::drawContours(figure.mask, std::vector<std::vector<cv::Point>>{outline}, 0, 255, cv::FILLED);
  bleed(figure.rgba);
  for (const cv::Point p : outline) figure.outline.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  return figure;
}

}  // namespace nt
