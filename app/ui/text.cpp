// SPDX-License-Identifier: Apache-2.0
#include "app/ui/text.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.5;
constexpr int kLineHeight = 20;
constexpr int kMargin = 6;

}  // namespace

void Text::set(const std::string& lines) {
  if (lines == lines_) return;
  lines_ = lines;
  ++revision_;
  std::vector<std::string> rows;
  std::istringstream in(lines);
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  int width = 1;
  for (const std::string& row : rows)
    width = std::max(width, cv::getTextSize(row, kFont, kFontScale, 1, nullptr).width);
  rgba_ = cv::Mat::zeros(static_cast<int>(rows.size()) * kLineHeight + kMargin, width + 2 * kMargin, CV_8UC4);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const cv::Point at(kMargin, static_cast<int>(i + 1) * kLineHeight - kMargin / 2);
    cv::putText(rgba_, rows[i], at, kFont, kFontScale, {16, 24, 32, 220}, 3, cv::LINE_AA);
    cv::putText(rgba_, rows[i], at, kFont, kFontScale, {255, 255, 255, 255}, 1, cv::LINE_AA);
  }
}

void Text::draw(Scene& scene, Vec2 at) const {
  if (rgba_.empty()) return;
  Picture picture;
  picture.pixels = rgba_.data;
  picture.width = rgba_.cols, picture.height = rgba_.rows, picture.stride = static_cast<int>(rgba_.step);
  picture.format = PixelFormat::rgba8, picture.id = id_, picture.revision = revision_;
  scene.image(picture, at, {static_cast<float>(rgba_.cols), static_cast<float>(rgba_.rows)});
}

}  // namespace nt
