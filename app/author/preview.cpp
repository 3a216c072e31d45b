// SPDX-License-Identifier: Apache-2.0
#include "app/author/preview.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "app/author/figure_frame.h"

namespace nt {
namespace {

const cv::Scalar kGround(240, 240, 240);

cv::Point pixel(Vec2 p) { return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))}; }

cv::Mat rgba_of(const Picture& texture) {
  return cv::Mat(texture.height, texture.width, CV_8UC4, const_cast<uint8_t*>(texture.pixels),
                 static_cast<std::size_t>(texture.stride));
}

cv::Mat drawing(const Character& character) {
  const cv::Mat rgba = rgba_of(character.texture);
  cv::Mat picture, alpha;
  cv::cvtColor(rgba, picture, cv::COLOR_RGBA2RGB);
  cv::extractChannel(rgba, alpha, 3);
  picture.setTo(kGround, alpha < 8);
  const auto corner = [&](uint32_t i) {
    const Vec2 uv = character.texcoords[i];
    return pixel({uv.x * static_cast<float>(rgba.cols) - 0.5f, uv.y * static_cast<float>(rgba.rows) - 0.5f});
  };
  for (std::size_t t = 0; t + 2 < character.triangles.size(); t += 3) {
    const std::vector<cv::Point> triangle = {corner(character.triangles[t]), corner(character.triangles[t + 1]),
                                             corner(character.triangles[t + 2])};
    cv::polylines(picture, triangle, true, {120, 120, 120}, 1, cv::LINE_AA);
  }
  return picture;
}

// The lowest triangles first, each in one tone: its texture's at the middle, by how much it faces the light.
cv::Mat top_view(const Character& c) {
  std::vector<Vec2> at;
  Vec2 most;
  for (const Vec2 v : c.vertices) {
    at.push_back(to_figure(c.figure, v));
    most = {std::max(most.x, at.back().x), std::max(most.y, at.back().y)};
  }
  constexpr float kMargin = 9;
  cv::Mat picture(static_cast<int>(most.y + kMargin), static_cast<int>(most.x + kMargin), CV_8UC3, kGround);
  const cv::Mat rgba = rgba_of(c.texture);
  std::vector<std::size_t> order(c.triangles.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t t) {
    return c.heights[c.triangles[3 * t]] + c.heights[c.triangles[3 * t + 1]] + c.heights[c.triangles[3 * t + 2]];
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  for (const std::size_t t : order) {
    cv::Point corners[3];
    Vec2 uv;
    float facing = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const uint32_t i = c.triangles[3 * t + k];
      corners[k] = pixel(at[i]);
      uv += c.texcoords[i] * (1.0f / 3);
      facing += (0.8f * c.normals[i].z + 0.3f * c.normals[i].y - 0.3f * c.normals[i].x) / 3;
    }
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(rgba.cols)), 0, rgba.cols - 1);
    const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(rgba.rows)), 0, rgba.rows - 1);
    const cv::Vec4b tone = rgba.at<cv::Vec4b>(y, x);
    if (tone[3] < 64) continue;
    const double light = 0.45 + 0.55 * static_cast<double>(std::clamp(std::abs(facing), 0.0f, 1.0f));
    cv::fillConvexPoly(picture, corners, 3, cv::Scalar(tone[0] * light, tone[1] * light, tone[2] * light), cv::LINE_AA);
  }
  return picture;
}

void draw_points(cv::Mat& picture, const Character& c) {
  const int radius = std::max(3, std::max(picture.cols, picture.rows) / 150);
  const auto point = [&](Vec2 at, cv::Scalar rgb) {
    cv::circle(picture, pixel(to_figure(c.figure, at)), radius, rgb, cv::FILLED, cv::LINE_AA);
  };
  const cv::Scalar cyan(40, 220, 255), yellow(255, 215, 20), green(20, 210, 60);
  point(c.rest.centre, {255, 255, 255});
  for (int i = 0; i < c.u_num; ++i) point(c.rest.up_axis[i], cyan);
  for (int i = 0; i < c.l_num; ++i) point(c.rest.low_axis[i], cyan);
  for (const FinPoints& fin : c.rest.fins) {
    if (fin.present) point(fin.tip, green), point(fin.top, yellow), point(fin.bottom, yellow);
  }
  point(c.rest.head, {240, 40, 30});
  point(c.rest.tail, {40, 90, 255});
}

}  // namespace

cv::Mat draw_preview(const Character& character) {
  cv::Mat picture = character.solid() ? top_view(character) : drawing(character);
  draw_points(picture, character);
  return picture;
}

}  // namespace nt
