// SPDX-License-Identifier: Apache-2.0
#include "core/segment/backlit.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

auto backlit_for(int width, int height) {
  return test::Made([=](Arena& arena) { return Backlit::create(arena, {BackgroundKind::backlit, 0}, width, height); });
}

// A field that falls off towards the corners.
Picture field(int width, int height, float middle, float fall) {
  Picture p(width, height);
  p.each([&](int x, int y, int) {
    const float u = 2 * static_cast<float>(x) / static_cast<float>(width) - 1;
    const float v = 2 * static_cast<float>(y) / static_cast<float>(height) - 1;
    return middle - fall * (u * u + v * v) + 6 * u;
  });
  return p;
}

struct Case {
  float middle, fall;
  int fish, polarity;
};

TEST(Backlit, FindsARestingFishInTheFirstFrame) {
  const int width = 203, height = 117;
  for (const Case c : {Case{210, 30, 60, -1}, Case{40, 10, 160, 1}}) {
    const Picture empty = field(width, height, c.middle, c.fall);
    Picture seen = empty;
    seen.ellipse(90, 60, 45, 12, c.fish);
    Random random(3);
    seen.noise(random, 1.5f);
    auto backlit = backlit_for(width, height);
    Bits fore(width, height);
    fore.soil();
    EXPECT_TRUE(backlit->apply(seen.luma(), nullptr, fore.mask()));
    EXPECT_EQ(backlit->polarity(), c.polarity);
    EXPECT_GT(backlit->smooth_share(), 0.85f);
    EXPECT_TRUE(test::clear_past_width(fore.mask()));
    int wrong = 0, area = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float u = (static_cast<float>(x) - 90) / 45, v = (static_cast<float>(y) - 60) / 12;
        const bool fish = u * u + v * v <= 1;
        area += fish, wrong += fish != fore.mask().at(x, y);
        ASSERT_LE(std::abs(backlit->estimate().row(y)[x] - empty.at(x, y)), 4) << "under the fish too";
      }
    }
    EXPECT_LT(wrong, area / 100);
  }
}

TEST(Backlit, OnlyTheFishsOwnPolarityCounts) {
  Picture seen = field(128, 80, 200, 20);
  seen.ellipse(40, 40, 20, 6, 60).ellipse(90, 40, 20, 6, 255);
  auto backlit = backlit_for(128, 80);
  Bits fore(128, 80);
  (void)backlit->apply(seen.luma(), nullptr, fore.mask());
  EXPECT_GT(test::count_in(fore.mask(), {20, 30, 60, 50}), 300);
  EXPECT_EQ(test::count_in(fore.mask(), {65, 0, 128, 80}), 0);
}

TEST(Backlit, ATexturedGroundIsNotASmoothField) {
  Picture seen(160, 90);
  seen.each([](int x, int y, int) { return (x / 20 + y / 20) % 2 != 0 ? 60 : 160; });
  auto backlit = backlit_for(160, 90);
  Bits fore(160, 90);
  (void)backlit->apply(seen.luma(), nullptr, fore.mask());
  auto smooth = backlit_for(160, 90);
  (void)smooth->apply(field(160, 90, 200, 20).luma(), nullptr, fore.mask());
  EXPECT_LT(backlit->smooth_share(), 0.7f);
  EXPECT_GT(smooth->smooth_share(), 0.99f);
}

TEST(Backlit, RestartFitsAnew) {
  auto backlit = backlit_for(64, 48);
  Bits fore(64, 48);
  (void)backlit->apply(field(64, 48, 210, 20).luma(), nullptr, fore.mask());
  EXPECT_EQ(backlit->polarity(), -1);
  backlit->restart();
  (void)backlit->apply(field(64, 48, 40, 10).luma(), nullptr, fore.mask());
  EXPECT_EQ(backlit->polarity(), 1);
  EXPECT_NEAR(backlit->estimate().row(24)[32], 40, 2);
  EXPECT_EQ(test::count_all(fore.mask()), 0);
}

TEST(Backlit, TinyAndEvenFramesAreEmpty) {
  for (const int side : {1, 2, 16}) {
    for (const int grey : {0, 128, 255}) {
      auto backlit = backlit_for(side, side);
      Bits fore(side, side);
      EXPECT_TRUE(backlit->apply(Picture(side, side, grey).luma(), nullptr, fore.mask()));
      EXPECT_EQ(test::count_all(fore.mask()), 0);
      EXPECT_NEAR(backlit->estimate().row(0)[0], grey, 1);
    }
  }
}

TEST(Backlit, NeverHasShadows) { EXPECT_FALSE(backlit_for(16, 16)->can_have_shadows()); }

}  // namespace
}  // namespace nt
