// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/block.h"

namespace {

constexpr int kWidth = 120, kHeight = 68;

// A smooth texture, known everywhere, in sixteenths of a grey level.
double tone(double x, double y) {
  return 1500 + 400 * std::sin(0.31 * x + 0.13 * y) + 350 * std::sin(0.17 * x - 0.41 * y + 1) +
         300 * std::cos(0.53 * y + 0.07 * x);
}

struct Small {
  std::vector<uint16_t> pixels = std::vector<uint16_t>(kWidth * kHeight);
  nt::SmallView view() const { return {pixels.data(), kWidth, kHeight, kWidth}; }
};

// What a camera sees that maps reference points (about the middle) by t.
Small seen(const nt::Similarity& t, double gain = 1, double offset = 0) {
  Small out;
  const nt::Similarity back = t.inverse();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double px = x - 0.5 * (kWidth - 1), py = y - 0.5 * (kHeight - 1);
      const double rx = back.a * px - back.b * py + back.x, ry = back.b * px + back.a * py + back.y;
      out.pixels[static_cast<std::size_t>(y * kWidth + x)] =
          static_cast<uint16_t>(std::lround(gain * tone(rx, ry) + offset));
    }
  return out;
}

class AlignTest : public testing::Test {
 protected:
  AlignTest() : block_(bytes()), arena_(block_.span()), align_(nt::Align::create(arena_, kWidth, kHeight)) {}
  static std::size_t bytes() {
    nt::Arena measure;
    nt::Align::create(measure, kWidth, kHeight);
    return measure.used();
  }
  static double worst_corner(const nt::Similarity& a, const nt::Similarity& b) {
    double worst = 0;
    for (const nt::Vec2 p : {nt::Vec2{-60, -34}, nt::Vec2{60, -34}, nt::Vec2{-60, 34}, nt::Vec2{60, 34}})
      worst = std::max<double>(worst, nt::length(a(p) - b(p)));
    return worst;
  }
  nt::test::Block block_;
  nt::Arena arena_;
  nt::Align* align_;
};

TEST_F(AlignTest, FindsShiftTurnAndScaleToAHundredth) {
  align_->set_reference(seen({}).view());
  for (const nt::Similarity truth : {nt::Similarity{1, 0, 0.4, -0.7}, nt::Similarity{1.02, 0, 0.3, 0},
                                     nt::Similarity{1, 0.02, 0, 0.2}, nt::Similarity{0.985, -0.015, -0.8, 0.5}}) {
    const nt::Alignment found = align_->find(seen(truth).view(), {}, 0.004f);
    EXPECT_TRUE(found.known);
    EXPECT_LT(worst_corner(found.seen_from_reference, truth), 0.03);
    EXPECT_GT(found.agreeing, 0.95);
    EXPECT_LT(found.left, 0.1);
  }
}

TEST_F(AlignTest, IsNotMovedByLight) {
  align_->set_reference(seen({}).view());
  const nt::Similarity truth{1.004, 0.003, 0.3, -0.2};
  const nt::Alignment found = align_->find(seen(truth, 1.15, 120).view(), {}, 0.004f);
  EXPECT_LT(worst_corner(found.seen_from_reference, truth), 0.06);
}

TEST_F(AlignTest, AThirdOfThePictureMayGoItsOwnWay) {
  align_->set_reference(seen({}).view());
  const nt::Similarity truth{1.003, 0.002, 0.3, 0.2};
  Small picture = seen(truth);
  const Small other = seen({1, 0, -1.5, 1.0});  // a large fish
  for (int y = 0; y < kHeight; ++y)
    for (int x = 30; x < 70; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      picture.pixels[i] = other.pixels[i];
    }
  const nt::Alignment found = align_->find(picture.view(), {}, 0.004f);
  EXPECT_LT(worst_corner(found.seen_from_reference, truth), 0.05);
  EXPECT_LT(found.agreeing, 0.85);
  EXPECT_GT(found.agreeing, 0.5);
}

TEST_F(AlignTest, AJoltIsFoundBySearching) {
  align_->set_reference(seen({}).view());
  const nt::Similarity truth{1.003, 0.002, 6.3, -4.2};
  const nt::Similarity start = align_->search(seen(truth).view(), {});
  EXPECT_NEAR(start.x, 6, 0.01);
  EXPECT_NEAR(start.y, -4, 0.01);
  const nt::Alignment found = align_->find(seen(truth).view(), start, 0.004f);
  EXPECT_LT(worst_corner(found.seen_from_reference, truth), 0.05);
}

TEST_F(AlignTest, WithoutTextureItSaysSo) {
  Small plain;
  for (uint16_t& p : plain.pixels) p = 1600;
  align_->set_reference(plain.view());
  EXPECT_EQ(align_->textured(), 0);
  EXPECT_FALSE(align_->find(seen({}).view(), {}, 0.004f).known);
}

TEST(Align, TinyPicturesHaveNoBlocks) {
  nt::Arena measure;
  nt::Align::create(measure, 8, 6);
  const nt::test::Block block(measure.used());
  nt::Arena arena(block.span());
  nt::Align* align = nt::Align::create(arena, 8, 6);
  ASSERT_NE(align, nullptr);
  const std::vector<uint16_t> pixels(48, 100);
  align->set_reference({pixels.data(), 8, 6, 8});
  EXPECT_FALSE(align->find({pixels.data(), 8, 6, 8}, {}, 0.004f).known);
}

}  // namespace
