// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_raster.h"

#include <gtest/gtest.h>

#include <vector>

namespace nt::tank {
namespace {

float total(const Coverage& cover) {
  float sum = 0;
  for (int y = cover.box().y0; y < cover.box().y1; ++y)
    for (int x = cover.box().x0; x < cover.box().x1; ++x) sum += cover.at(x, y);
  return sum;
}

TEST(TankRaster, ASquareCoversItsPixelsExactly) {
  const std::vector<Vec2> square = {{1.5f, 1.5f}, {4.0f, 1.5f}, {4.0f, 3.5f}, {1.5f, 3.5f}};
  Coverage cover;
  cover.start({0, 0, 8, 8});
  cover.add(square);
  cover.finish();
  EXPECT_FLOAT_EQ(cover.at(1, 2), 0.0f);
  EXPECT_FLOAT_EQ(cover.at(2, 2), 1.0f);
  EXPECT_FLOAT_EQ(cover.at(3, 3), 1.0f);
  EXPECT_FLOAT_EQ(cover.at(4, 2), 0.5f);
  EXPECT_FLOAT_EQ(cover.at(2, 1), 0.0f);
  EXPECT_FLOAT_EQ(cover.at(2, 4), 0.0f);
  EXPECT_FLOAT_EQ(total(cover), 5.0f);
}

TEST(TankRaster, CoverageSumsToThePolygonsAreaInEitherSense) {
  const std::vector<Vec2> forward = {{3.2f, 1.1f}, {27.7f, 8.3f}, {17.0f, 24.9f}, {6.0f, 14.0f}};
  const std::vector<Vec2> backward(forward.rbegin(), forward.rend());
  float area = 0;
  for (std::size_t i = 0; i < forward.size(); ++i) area += 0.5f * cross(forward[i], forward[(i + 1) % forward.size()]);
  for (const auto& polygon : {forward, backward}) {
    Coverage cover;
    cover.start(box_of(polygon, 1));
    cover.add(polygon);
    cover.finish();
    EXPECT_NEAR(total(cover), area, 0.01f);
  }
}

TEST(TankRaster, OverlapsCountOnce) {
  const std::vector<Vec2> square = {{0.5f, 0.5f}, {5.5f, 0.5f}, {5.5f, 5.5f}, {0.5f, 5.5f}};
  Coverage cover;
  cover.start({0, 0, 12, 12});
  cover.add(square);
  cover.add(square, {2.0f, 2.0f});
  cover.finish();
  EXPECT_NEAR(total(cover), 25.0f + 25.0f - 9.0f, 1e-3f);
}

TEST(TankRaster, BlurKeepsTheMassAndSpreadsItEvenly) {
  const std::vector<Vec2> square = {{19.5f, 19.5f}, {20.5f, 19.5f}, {20.5f, 20.5f}, {19.5f, 20.5f}};
  Coverage cover;
  cover.start({0, 0, 41, 41});
  cover.add(square);
  cover.finish();
  cover.blur(3);
  EXPECT_NEAR(total(cover), 1.0f, 1e-3f);
  float variance = 0;
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) variance += cover.at(x, y) * static_cast<float>((x - 20) * (x - 20));
  EXPECT_NEAR(variance, 3.0f * 4.0f, 0.05f);  // r (r + 1)
  EXPECT_NEAR(cover.at(20, 14), cover.at(20, 26), 1e-6f);
  EXPECT_NEAR(cover.at(14, 20), cover.at(20, 14), 1e-6f);
}

}  // namespace
}  // namespace nt::tank
