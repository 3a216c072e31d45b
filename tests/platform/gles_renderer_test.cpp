// SPDX-License-Identifier: Apache-2.0
// What each item looks like, pixel by pixel, drawn off-screen.
#include "platform/display/gles_renderer.h"

#include <vector>

#include "tests/platform/test_scene.h"

namespace nt {
namespace {

class GlesRendererTest : public ::testing::Test {
 protected:
  void open(int width, int height) {
    try {
      display_ = open_headless_display(width, height);
    } catch (const UserError& error) {
      GTEST_SKIP() << error.what();
    }
    width_ = width, height_ = height;
  }
  void draw(const Scene& scene) {
    display_->draw(scene);
    const auto pixels = display_->pixels();
    shot_.assign(pixels.begin(), pixels.end());
    ASSERT_EQ(shot_.size(), static_cast<std::size_t>(width_ * height_ * 3));
  }
  Rgb at(int x, int y) const { return pixel(shot_, width_, x, y); }
  // Sum of the red channel down a column, in full pixels: the thickness of a white band on black.
  double column(int x) const {
    double sum = 0;
    for (int y = 0; y < height_; ++y) sum += at(x, y).r;
    return sum / 255.0;
  }
  double whole() const {
    double sum = 0;
    for (int x = 0; x < width_; ++x) sum += column(x);
    return sum;
  }
  Scene blank() const {
    Scene scene;
    scene.clear(width_, height_, {0, 0, 0, 1});
    return scene;
  }

  std::unique_ptr<Display> display_;
  std::vector<uint8_t> shot_;
  int width_ = 0, height_ = 0;
};

TEST_F(GlesRendererTest, PlacesAnImageUprightAndExactly) {
  open(64, 48);
  if (!display_) return;
  std::vector<uint8_t> rgb;  // 4x2, every pixel of its own colour
  for (int i = 0; i < 8; ++i)
    rgb.insert(rgb.end(), {static_cast<uint8_t>(30 * i), static_cast<uint8_t>(255 - 30 * i), 7});
  Scene scene = blank();
  scene.image(picture_of(rgb, 4, 2, PixelFormat::rgb8, 1), {8, 16}, {4, 2});
  draw(scene);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(near_colour(at(8 + i % 4, 16 + i / 4), {30 * i, 255 - 30 * i, 7}, 1)) << i;
  }
  for (const auto& [x, y] : {std::pair{7, 16}, {12, 16}, {8, 15}, {8, 18}})
    EXPECT_TRUE(near_colour(at(x, y), {0, 0, 0}));
}

TEST_F(GlesRendererTest, LumaIsGreyAndPaddedRowsAreSkipped) {
  open(8, 8);
  if (!display_) return;
  const std::vector<uint8_t> padded = {10, 200, 99, 99, 99, 60, 120, 99, 99, 99};  // 2x2 with a stride of 5
  Picture picture = picture_of(padded, 2, 2, PixelFormat::luma8, 3);
  picture.stride = 5;
  Scene scene = blank();
  scene.image(picture, {2, 2}, {2, 2});
  draw(scene);
  EXPECT_TRUE(near_colour(at(2, 2), {10, 10, 10}, 1));
  EXPECT_TRUE(near_colour(at(3, 2), {200, 200, 200}, 1));
  EXPECT_TRUE(near_colour(at(2, 3), {60, 60, 60}, 1));
  EXPECT_TRUE(near_colour(at(3, 3), {120, 120, 120}, 1));
}

TEST_F(GlesRendererTest, UploadsAgainOnlyWhenTheRevisionChanges) {
  open(8, 8);
  if (!display_) return;
  std::vector<uint8_t> grey = {50};
  const auto shown = [&](uint64_t revision) {
    Scene scene = blank();
    scene.image(picture_of(grey, 1, 1, PixelFormat::luma8, 4, revision), {0, 0}, {8, 8});
    draw(scene);
    return at(4, 4).r;
  };
  EXPECT_NEAR(shown(1), 50, 1);
  grey[0] = 150;
  EXPECT_NEAR(shown(1), 50, 1);
  EXPECT_NEAR(shown(2), 150, 1);
  const std::vector<uint8_t> wider = {0, 0, 250, 250, 0, 0};  // same id, new size and format
  Scene scene = blank();
  scene.image(picture_of(wider, 2, 1, PixelFormat::rgb8, 4, 2), {0, 0}, {8, 8});
  draw(scene);
  EXPECT_TRUE(near_colour(at(7, 4), {250, 0, 0}));
}

TEST_F(GlesRendererTest, AreasAndPlainMeshesAreOfOneColour) {
  open(16, 16);
  if (!display_) return;
  const std::array<Vec2, 3> corners = {Vec2{8, 8}, {16, 8}, {8, 16}};
  const std::array<uint32_t, 3> triangle = {0, 1, 2};
  Scene scene = blank();
  scene.area({2, 2}, {4, 4}, {1, 0, 0, 1});
  scene.area({4, 2}, {4, 4}, {0, 1, 0, 0.5f});
  scene.plain(corners, triangle, {0, 0, 1, 1});
  draw(scene);
  EXPECT_TRUE(near_colour(at(2, 2), {255, 0, 0}));
  EXPECT_TRUE(near_colour(at(5, 5), {128, 128, 0}));
  EXPECT_TRUE(near_colour(at(7, 3), {0, 128, 0}));
  EXPECT_TRUE(near_colour(at(9, 9), {0, 0, 255}));
  for (const auto& [x, y] : {std::pair{1, 2}, {6, 6}, {8, 3}, {14, 14}}) EXPECT_TRUE(near_colour(at(x, y), {0, 0, 0}));
}

TEST_F(GlesRendererTest, BlendsAlphaAndTint) {
  open(8, 8);
  if (!display_) return;
  const std::vector<uint8_t> half_red = {255, 0, 0, 128};
  Scene scene;
  scene.clear(8, 8, {0, 0, 1, 1});
  scene.image(picture_of(half_red, 1, 1, PixelFormat::rgba8, 5), {0, 0}, {4, 8});
  scene.image(picture_of(half_red, 1, 1, PixelFormat::rgba8, 5), {4, 0}, {4, 8}, {0.5f, 1, 1, 0.5f});
  draw(scene);
  EXPECT_TRUE(near_colour(at(1, 4), {128, 0, 127}));
  EXPECT_TRUE(near_colour(at(6, 4), {32, 0, 191}));
}

TEST_F(GlesRendererTest, ClearTexelsDoNotDarkenTheEdgeOfADrawing) {
  open(64, 8);
  if (!display_) return;
  const std::vector<uint8_t> edge = {255, 255, 255, 255, 0, 0, 0, 0};  // white beside clear black
  Scene scene;
  scene.clear(64, 8, {1, 1, 1, 1});
  scene.image(picture_of(edge, 2, 1, PixelFormat::rgba8, 6), {0, 0}, {64, 8});
  draw(scene);
  for (int x = 0; x < 64; ++x) EXPECT_TRUE(near_colour(at(x, 4), {255, 255, 255})) << x;
}

TEST_F(GlesRendererTest, MeshTakesItsTextureByTexcoords) {
  open(kTestWidth, kTestHeight);
  if (!display_) return;
  TestScene test;
  test.texcoords = {Vec2{1, 0}, {0, 0}, {1, 1}, {0, 1}};  // mirrored: green left, red right
  draw(test.scene);
  EXPECT_TRUE(near_colour(at(93, 40), {0, 255, 0}));
  EXPECT_TRUE(near_colour(at(126, 40), {255, 0, 0}));
  EXPECT_TRUE(near_colour(at(132, 40), {51, 51, 51}));
  EXPECT_TRUE(near_colour(at(110, 62), {51, 51, 51}));
}

TEST_F(GlesRendererTest, MeshIndicesPastTheVerticesAreLeftOut) {
  open(kTestWidth, kTestHeight);
  if (!display_) return;
  TestScene test;
  test.triangles = {0, 1, 2, 2, 1, 4000000000u};
  draw(test.scene);
  EXPECT_TRUE(near_colour(at(93, 23), {255, 0, 0}));
  EXPECT_TRUE(near_colour(at(128, 58), {51, 51, 51}));
}

TEST_F(GlesRendererTest, LinesHaveTheirThicknessAndSoftEdges) {
  open(100, 100);
  if (!display_) return;
  for (const float width_px : {0.5f, 1.0f, 2.5f, 7.0f}) {
    const std::vector<Vec2> strip = {{10, 50.25f}, {50, 50.25f}, {90, 50.25f}};
    Scene scene = blank();
    scene.lines(strip, {1, 1, 1, 1}, width_px);
    draw(scene);
    EXPECT_NEAR(column(30), width_px, 0.3) << width_px;
    EXPECT_NEAR(column(50), width_px, 0.3) << "at the join of " << width_px;
    EXPECT_EQ(column(5), 0) << width_px;
    EXPECT_EQ(column(95), 0) << width_px;
  }
  bool soft = false;
  for (int y = 0; y < 100; ++y) soft = soft || (at(30, y).r > 20 && at(30, y).r < 235);
  EXPECT_TRUE(soft);
}

TEST_F(GlesRendererTest, JoinsDoNotBlendTwiceAndCornersAreFilled) {
  open(100, 100);
  if (!display_) return;
  const std::vector<Vec2> corner = {{20, 80}, {20, 20}, {80, 20}, {80, 80}};
  Scene scene = blank();
  scene.lines(corner, {1, 1, 1, 0.5f}, 8, true);
  draw(scene);
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y) EXPECT_LE(at(x, y).r, 129) << x << "," << y;
  }
  EXPECT_NEAR(at(18, 18).r, 128, 2);  // the outer corner of the mitre
  EXPECT_NEAR(at(50, 80).r, 128, 2);  // the closing side
  EXPECT_EQ(at(50, 50).r, 0);
}

TEST_F(GlesRendererTest, DenseAndFoldedLinesStayInsideTheirThickness) {
  open(100, 100);
  if (!display_) return;
  std::vector<Vec2> strip;
  for (int i = 0; i < 60; ++i)
    strip.push_back({20.0f + static_cast<float>(i), i % 2 == 0 ? 50.0f : 51.0f});  // staircase
  strip.push_back({20, 50.5f});                                                    // and back
  strip.push_back({20, 50.5f});
  Scene scene = blank();
  scene.lines(strip, {1, 1, 1, 1}, 4);
  draw(scene);
  for (int x = 0; x < 100; ++x) {
    for (const int y : {44, 57}) EXPECT_EQ(at(x, y).r, 0) << x;
  }
  EXPECT_NEAR(at(50, 50).r, 255, 2);
}

TEST_F(GlesRendererTest, PointsAreRoundDiscs) {
  open(100, 100);
  if (!display_) return;
  const std::vector<Vec2> centres = {{30, 30}, {70, 70}};
  Scene scene = blank();
  scene.points(centres, {1, 1, 1, 1}, 20);
  draw(scene);
  EXPECT_NEAR(whole(), 2 * 3.14159 * 100, 8);  // two discs of radius 10
  EXPECT_EQ(at(30, 30).r, 255);
  EXPECT_EQ(at(38, 30).r, 255);
  EXPECT_EQ(at(38, 38).r, 0);  // the corner of the square round it
  EXPECT_EQ(at(70, 70).r, 255);
}

TEST_F(GlesRendererTest, KeepsTheCanvasAspectWithBlackBars) {
  open(200, 100);
  if (!display_) return;
  Scene scene;
  scene.clear(50, 50, {1, 1, 1, 1});
  const std::vector<Vec2> sticking_out = {{-100, 25}, {100, 25}};
  scene.lines(sticking_out, {1, 0, 0, 1}, 4);
  draw(scene);
  EXPECT_TRUE(near_colour(at(49, 10), {0, 0, 0}));
  EXPECT_TRUE(near_colour(at(51, 10), {255, 255, 255}));
  EXPECT_TRUE(near_colour(at(148, 10), {255, 255, 255}));
  EXPECT_TRUE(near_colour(at(151, 10), {0, 0, 0}));
  EXPECT_TRUE(near_colour(at(100, 50), {255, 0, 0}));
  EXPECT_TRUE(near_colour(at(20, 50), {0, 0, 0}));  // nothing is drawn in the bars
  const CanvasFit fit = fit_canvas(50, 50, 200, 100);
  EXPECT_FLOAT_EQ(fit.scale, 2);
  EXPECT_EQ(fit.x, 50);
  EXPECT_EQ(fit.y, 0);
}

// Two squares over one another, left half red and right half green, the second one drawn later.
struct TwoSquares {
  std::vector<uint8_t> texture = {200, 0, 0, 255, 0, 200, 0, 255};
  std::vector<Vec2> at = {{10, 10}, {50, 10}, {10, 50}, {50, 50}, {30, 30}, {70, 30}, {30, 70}, {70, 70}};
  std::vector<float> heights = {9, 9, 9, 9, 2, 2, 2, 2};
  std::vector<Vec3> normals = std::vector<Vec3>(8, Vec3{0, 0, 5});
  std::vector<Vec2> uv =
      std::vector<Vec2>{{0.1f, 0}, {0.1f, 0}, {0.1f, 0}, {0.1f, 0}, {0.9f, 0}, {0.9f, 0}, {0.9f, 0}, {0.9f, 0}};
  std::vector<uint32_t> triangles = {0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7};
  void add(Scene& scene, Colour tint = {}) const {
    scene.solid(picture_of(texture, 2, 1, PixelFormat::rgba8, 11), at, heights, normals, uv, triangles, tint);
  }
};

TEST_F(GlesRendererTest, WhatIsHigherHidesWhatIsLower) {
  open(80, 80);
  if (!display_) return;
  TwoSquares squares;
  Scene scene = blank();
  squares.add(scene);
  draw(scene);
  EXPECT_GT(at(40, 40).r, 100);
  EXPECT_EQ(at(40, 40).g, 0);
  EXPECT_GT(at(60, 60).g, 100);
  std::swap(squares.heights[0], squares.heights[4]), std::swap(squares.heights[1], squares.heights[5]);
  std::swap(squares.heights[2], squares.heights[6]), std::swap(squares.heights[3], squares.heights[7]);
  scene = blank();
  squares.add(scene);
  draw(scene);
  EXPECT_GT(at(40, 40).g, 100);
  EXPECT_EQ(at(40, 40).r, 0);
}

TEST_F(GlesRendererTest, ASolidCoversWhatWasDrawnBeforeItHoweverHigh) {
  open(80, 80);
  if (!display_) return;
  TwoSquares high, low;
  for (float& h : high.heights) h += 1000;
  low.texture = {0, 0, 200, 255, 0, 0, 200, 255};
  Scene scene = blank();
  high.add(scene);
  scene.solid(picture_of(low.texture, 2, 1, PixelFormat::rgba8, 12), low.at, low.heights, low.normals, low.uv,
              low.triangles);
  const Vec2 dot{20, 20};
  scene.points({&dot, 1}, {1, 1, 1, 1}, 6);  // flat items are not hidden by a solid either
  draw(scene);
  EXPECT_GT(at(40, 40).b, 100);
  EXPECT_EQ(at(40, 40).r, 0);
  EXPECT_TRUE(near_colour(at(20, 20), {255, 255, 255}));
}

TEST_F(GlesRendererTest, SolidsAreLitFromTheUpperLeftOnBothSides) {
  open(80, 80);
  if (!display_) return;
  const auto lit = [&](Vec3 normal) {
    TwoSquares squares;
    squares.normals.assign(8, normal);
    Scene scene = blank();
    squares.add(scene);
    draw(scene);
    return at(20, 20).r;
  };
  const int facing = lit({0, 0, 1}), left = lit({-0.7f, -0.7f, 0.7f}), right = lit({0.7f, 0.7f, 0.7f});
  EXPECT_GT(left, facing - 2);
  EXPECT_LT(right, facing - 30);
  EXPECT_NEAR(lit({0, 0, -1}), facing, 1);
  EXPECT_NEAR(facing, 200, 10);  // a face that looks at the viewer keeps its own colour
}

TEST_F(GlesRendererTest, ClearTexelsOfASolidHideNothingAndItFades) {
  open(80, 80);
  if (!display_) return;
  TwoSquares squares;
  squares.texture = {200, 0, 0, 0, 0, 200, 0, 255};  // the upper square is clear
  Scene scene = blank();
  squares.add(scene);
  draw(scene);
  const int whole = at(40, 40).g;
  EXPECT_GT(whole, 100);
  EXPECT_TRUE(near_colour(at(20, 20), {0, 0, 0}));
  scene = blank();
  squares.add(scene, {1, 1, 1, 0.5f});
  draw(scene);
  EXPECT_NEAR(at(40, 40).g, whole / 2, 3);
}

TEST_F(GlesRendererTest, EmptyAndBrokenItemsDrawNothing) {
  open(32, 32);
  if (!display_) return;
  const std::vector<Vec2> one = {{16, 16}};
  const std::vector<Vec2> twice = {{16, 16}, {16, 16}};
  Scene scene = blank();
  scene.image({}, {0, 0}, {32, 32});
  scene.mesh({}, one, one, {});
  scene.lines({}, {}, 3);
  scene.lines(one, {}, 3, true);
  scene.lines(twice, {}, 3, true);
  scene.points(one, {}, 0);
  draw(scene);
  EXPECT_EQ(whole(), 0);
}

}  // namespace
}  // namespace nt
