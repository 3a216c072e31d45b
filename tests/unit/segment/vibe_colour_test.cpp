// SPDX-License-Identifier: Apache-2.0
#include "core/segment/vibe_colour.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

auto model_for(int width, int height) {
  return test::Made([=](Arena& arena) {
    return VibeColour::create(arena, {BackgroundKind::vibe_colour, 0}, width, height, 1);
  });
}

TEST(HalfMasks, ABitStandsForItsBlockBothWays) {
  for (const int width : {1, 2, 63, 64, 65, 127, 128, 129, 200}) {
    for (const int height : {1, 2, 5}) {
      Random random(static_cast<uint64_t>(width * 10 + height));
      const int w = (width + 1) / 2, h = (height + 1) / 2;
      Bits from(width, height), also(width, height), half(w, h), none(w, h), back(width, height);
      from.scatter(random, 7), also.scatter(random, 11);
      half.soil();
      halve_mask(from.mask(), &also.mask(), half.mask());
      add_doubled(none.mask(), half.mask(), back.mask());
      EXPECT_TRUE(test::clear_past_width(half.mask())) << width;
      EXPECT_TRUE(test::clear_past_width(back.mask())) << width;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          bool any = false;
          for (int dy = 0; dy < 2; ++dy)
            for (int dx = 0; dx < 2; ++dx)
              any |= from.mask().at(x / 2 * 2 + dx, y / 2 * 2 + dy) || also.mask().at(x / 2 * 2 + dx, y / 2 * 2 + dy);
          ASSERT_EQ(half.mask().at(x / 2, y / 2), any) << width << "x" << height;
          ASSERT_EQ(back.mask().at(x, y), any) << width << "x" << height;
        }
      }
    }
  }
}

TEST(VibeColour, FindsByColourWhatIsAsBrightAsTheGround) {
  const int width = 131, height = 47;
  const Box fish{40, 10, 100, 30};
  auto model = model_for(width, height);
  auto grey = test::Made([=](Arena& arena) { return Vibe::create(arena, {}, width, height, 1); });
  Bits fore(width, height), grey_fore(width, height);
  const Picture luma(width, height, 100);
  Picture cb(66, 24, 128), cr(66, 24, 128);
  for (int n = 0; n < 10; ++n) {
    model->see_chroma(cb.luma(), cr.luma());
    EXPECT_EQ(model->apply(luma.luma(), nullptr, fore.mask()), n > 0);
    EXPECT_EQ(test::count_all(fore.mask()), 0);
  }
  cr.paint({20, 5, 50, 15}, 170);
  model->see_chroma(cb.luma(), cr.luma());
  (void)model->apply(luma.luma(), nullptr, fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), fish), 60 * 20);
  EXPECT_EQ(test::count_all(fore.mask()), 60 * 20);
  (void)grey->apply(luma.luma(), nullptr, grey_fore.mask());
  (void)grey->apply(luma.luma(), nullptr, grey_fore.mask());
  EXPECT_EQ(test::count_all(grey_fore.mask()), 0) << "luma alone sees nothing";

  const nt::Run runs[] = {{10, 40, 100, 0}, {11, 40, 100, 1}};
  model->absorb(luma.luma(), runs, 0);
  (void)model->apply(luma.luma(), nullptr, fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), {40, 10, 100, 12}), 0) << "absorbed, block by block";
  EXPECT_EQ(test::count_all(fore.mask()), 60 * 18);
}

TEST(VibeColour, WithoutChromaOrWithChromaOfAnotherSizeLumaDecides) {
  auto model = model_for(64, 32);
  Bits fore(64, 32);
  const Picture odd(10, 10, 200);
  for (int n = 0; n < 5; ++n) {
    if (n == 2) model->see_chroma(odd.luma(), odd.luma());
    (void)model->apply(Picture(64, 32, 100).luma(), nullptr, fore.mask());
    EXPECT_EQ(test::count_all(fore.mask()), 0);
  }
  Picture seen(64, 32, 100);
  (void)model->apply(seen.paint({10, 10, 30, 16}, 200).luma(), nullptr, fore.mask());
  EXPECT_EQ(test::count_all(fore.mask()), 120);
}

TEST(VibeColour, TooLittleMemoryGivesNullHoweverLittle) {
  Arena measure;
  (void)VibeColour::create(measure, {}, 64, 10, 1);
  const test::Block block(measure.used());
  for (std::size_t bytes = 0; bytes < measure.used(); bytes += 64) {
    Arena arena(block.span().first(bytes));
    EXPECT_EQ(VibeColour::create(arena, {}, 64, 10, 1), nullptr) << bytes;
  }
}

}  // namespace
}  // namespace nt
