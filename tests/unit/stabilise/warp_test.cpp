// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/warp.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/base/random.h"

namespace {

struct Picture {
  Picture(int w, int h, int padding = 0) : width(w), height(h), stride(w + padding), pixels(make_size()) {}
  std::size_t make_size() const { return static_cast<std::size_t>(stride) * static_cast<std::size_t>(height); }
  nt::LumaView view() const { return {pixels.data(), width, height, stride}; }
  nt::ImageView<uint8_t> out() { return {pixels.data(), width, height, stride}; }
  uint8_t at(int x, int y) const { return pixels[static_cast<std::size_t>(y * stride + x)]; }
  int width, height, stride;
  std::vector<uint8_t> pixels;
};

Picture noise(int width, int height, uint64_t seed) {
  Picture picture(width, height, 3);
  nt::Random random(seed);
  for (uint8_t& p : picture.pixels) p = static_cast<uint8_t>(random.below(256));
  return picture;
}

TEST(Warp, TheIdentityCopiesAllButTheLastRowAndColumn) {
  const Picture from = noise(101, 37, 1);
  Picture fill(101, 37), to(101, 37);
  const float seen = nt::warp_luma(from.view(), {}, fill.view(), to.out());
  EXPECT_NEAR(seen, 100.0 * 36 / (101 * 37), 1e-5);  // bilinear needs the next pixel
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 100; ++x) ASSERT_EQ(to.at(x, y), from.at(x, y)) << x << " " << y;
}

TEST(Warp, LanesAndPlainAgreeToTheByte) {
  nt::Random random(5);
  const Picture from = noise(203, 95, 2);
  const Picture fill = noise(203, 95, 3);
  for (int trial = 0; trial < 60; ++trial) {
    nt::Similarity t{0.82 + 0.36 * random.unit(), 0.22 * random.unit() - 0.11, 60 * random.unit() - 30,
                     60 * random.unit() - 30};
    ASSERT_TRUE(nt::can_warp(t));
    Picture fast(203, 95), plain(203, 95);
    const float seen = nt::warp_luma(from.view(), t, fill.view(), fast.out());
    EXPECT_EQ(seen, nt::warp_luma_plain(from.view(), t, fill.view(), plain.out()));
    ASSERT_EQ(fast.pixels, plain.pixels) << trial;
  }
}

TEST(Warp, APlaneOfLightIsResampledExactly) {
  // 2 x + 3 y is linear, so bilinear samples of it are right but for the 1/16 pixel of the weights and rounding.
  Picture from(64, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 64; ++x)
      from.pixels[static_cast<std::size_t>(y * 64 + x)] = static_cast<uint8_t>(2 * x + 3 * y);
  Picture fill(64, 40), to(64, 40);
  const nt::Similarity t{0.98, 0.03, 1.3, -0.4};
  nt::warp_luma(from.view(), t, fill.view(), to.out());
  for (int y = 3; y < 36; ++y)
    for (int x = 3; x < 58; ++x) {
      const nt::Vec2 p = t({static_cast<float>(x), static_cast<float>(y)});
      EXPECT_NEAR(to.at(x, y), 2 * p.x + 3 * p.y, 0.5 + 5.0 / 16);
    }
}

TEST(Warp, WhatTheFrameDoesNotShowComesFromTheFill) {
  const Picture from = noise(64, 48, 4);
  Picture fill(64, 48), to(64, 48);
  for (uint8_t& p : fill.pixels) p = 77;
  const float seen = nt::warp_luma(from.view(), {1, 0, 20, 0}, fill.view(), to.out());
  EXPECT_NEAR(seen, 43.0 * 47 / (64 * 48), 1e-5);
  for (int y = 0; y < 47; ++y) {
    EXPECT_EQ(to.at(42, y), from.at(62, y));
    EXPECT_EQ(to.at(43, y), 77);
  }
}

}  // namespace
