// SPDX-License-Identifier: Apache-2.0
// A scene with one of everything, and a look at single pixels of what was drawn. Shared by the display tests.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "platform/camera.h"
#include "platform/display.h"

namespace nt {

struct Rgb {
  int r = 0, g = 0, b = 0;
};

inline Rgb pixel(std::span<const uint8_t> rgb, int width, int x, int y) {
  const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
  return {rgb[at], rgb[at + 1], rgb[at + 2]};
}

inline ::testing::AssertionResult near_colour(Rgb got, Rgb want, int tolerance = 2) {
  const auto off = [&](int a, int b) { return std::abs(a - b) > tolerance; };
  if (!off(got.r, want.r) && !off(got.g, want.g) && !off(got.b, want.b)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "got " << got.r << "," << got.g << "," << got.b << " want " << want.r << ","
                                       << want.g << "," << want.b;
}

inline Picture picture_of(std::span<const uint8_t> pixels, int width, int height, PixelFormat format, uint32_t id,
                          uint64_t revision = 1) {
  const int channels = format == PixelFormat::luma8 ? 1 : (format == PixelFormat::rgb8 ? 3 : 4);
  return {pixels.data(), width, height, width * channels, format, id, revision};
}

inline constexpr int kTestWidth = 160;
inline constexpr int kTestHeight = 120;

// 160x120: grey image top left, red-green texture on a square mesh, a white line, a blue point, a half-clear yellow loop.
struct TestScene {
  std::array<uint8_t, 4> grey = {0, 80, 160, 255};                                                     // 2x2
  std::array<uint8_t, 16> drawing = {255, 0, 0, 255, 0, 255, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255};  // red | green
  std::array<Vec2, 4> corners = {Vec2{90, 20}, {130, 20}, {90, 60}, {130, 60}};
  std::array<Vec2, 4> texcoords = {Vec2{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  std::array<uint32_t, 6> triangles = {0, 1, 2, 2, 1, 3};
  std::array<Vec2, 2> line = {Vec2{10, 90}, {70, 90}};
  std::array<Vec2, 1> dot = {Vec2{120, 90}};
  std::array<Vec2, 3> loop = {Vec2{20, 60}, {50, 110}, {80, 60}};
  Scene scene;
  TestScene() {
    scene.clear(kTestWidth, kTestHeight, {0.2f, 0.2f, 0.2f, 1});
    scene.image(picture_of(grey, 2, 2, PixelFormat::luma8, 1), {0, 0}, {40, 40});
    scene.mesh(picture_of(drawing, 2, 2, PixelFormat::rgba8, 2), corners, texcoords, triangles);
    scene.lines(line, {1, 1, 1, 1}, 6);
    scene.points(dot, {0, 0, 1, 1}, 20);
    scene.lines(loop, {1, 1, 0, 0.5f}, 4, true);
  }
};

}  // namespace nt
