// SPDX-License-Identifier: Apache-2.0
#include "core/segment/vibe.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

auto vibe_for(int width, int height, int radius = 20, uint64_t seed = 1) {
  return test::Made([=](Arena& arena) {
    return Vibe::create(arena, {BackgroundKind::vibe, radius}, width, height, seed);
  });
}

TEST(Vibe, TheFirstFrameIsOnlyLearned) {
  auto vibe = vibe_for(70, 9);
  Bits fore(70, 9);
  fore.soil();
  EXPECT_FALSE(vibe->apply(Picture(70, 9, 100).luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 0);
  EXPECT_TRUE(vibe->apply(Picture(70, 9, 100).luma(), nullptr, fore.mask()));
}

TEST(Vibe, APictureLearnedBeforehandMakesTheFirstMaskMeanSomething) {
  auto vibe = vibe_for(70, 9);
  vibe->learn(Picture(70, 9, 100).luma());
  Picture seen(70, 9, 100);
  seen.paint({60, 2, 70, 5}, 200);
  Bits fore(70, 9);
  EXPECT_TRUE(vibe->apply(seen.luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 30);
  EXPECT_EQ(test::count_in(fore.mask(), {60, 2, 70, 5}), 30);
}

TEST(Vibe, ANewObjectIsForegroundAtOnceAndExactlyAtAnyWidth) {
  for (const int width : {2, 15, 16, 63, 64, 65, 127, 130, 200}) {
    for (const int height : {1, 2, 17}) {
      auto vibe = vibe_for(width, height);
      Bits fore(width, height);
      for (int n = 0; n < 8; ++n) (void)vibe->apply(Picture(width, height, 60).luma(), nullptr, fore.mask());
      EXPECT_EQ(test::count_all(fore.mask()), 0);
      const Box object{width / 2, height / 2, width, height};
      Picture seen(width, height, 60);
      seen.paint(object, 81);
      fore.soil();
      EXPECT_TRUE(vibe->apply(seen.luma(), nullptr, fore.mask()));
      EXPECT_EQ(test::count_in(fore.mask(), object), object.width() * object.height()) << width << "x" << height;
      EXPECT_EQ(test::count_all(fore.mask()), object.width() * object.height());
      EXPECT_TRUE(test::clear_past_width(fore.mask())) << width;
      seen.paint(object, 80);  // a difference of the radius still matches
      (void)vibe->apply(seen.luma(), nullptr, fore.mask());
      EXPECT_EQ(test::count_all(fore.mask()), 0) << width << "x" << height;
    }
  }
}

TEST(Vibe, AStillNoisySceneGivesAnAlmostEmptyMask) {
  auto vibe = vibe_for(200, 90, 0);
  Random random(4);
  Picture ground(200, 90);
  ground.each([](int x, int y, int) { return 60 + x / 2 + (x / 8 + y / 8) % 2 * 20; });
  Bits fore(200, 90);
  for (int n = 0; n < 120; ++n) {
    Picture seen = ground;
    seen.noise(random, 2.5f);
    (void)vibe->apply(seen.luma(), nullptr, fore.mask());
    ASSERT_LT(test::count_all(fore.mask()), 200 * 90 / 200) << n;
  }
  EXPECT_NEAR(vibe->noise_sigma(), 2.5f, 0.3f);
  EXPECT_NEAR(vibe->radius(), 20, 2);
}

TEST(Vibe, TheRadiusIsTheSettingsOrFollowsTheNoise) {
  EXPECT_EQ(vibe_for(20, 20, 33)->radius(), 33);
  auto vibe = vibe_for(64, 64, 0);
  EXPECT_EQ(vibe->radius(), 20) << "the paper's, until the noise is known";
  Random random(5);
  Bits fore(64, 64);
  for (int n = 0; n < 30; ++n) (void)vibe->apply(Picture(64, 64, 100).noise(random, 12).luma(), nullptr, fore.mask());
  EXPECT_GT(vibe->radius(), 24);
}

// Slow light moves both patches by less than the radius; only the one outside `keep` may follow it.
TEST(Vibe, WhatIsKeptIsNeverLearnedAndWhatIsNotIs) {
  const int width = 130, height = 40;
  const Box kept{10, 10, 40, 30}, learned{70, 10, 100, 30};
  auto vibe = vibe_for(width, height);
  Bits fore(width, height), keep(width, height);
  keep.paint(kept);
  (void)vibe->apply(Picture(width, height, 100).luma(), nullptr, fore.mask());
  Picture seen(width, height, 100);
  seen.paint(kept, 115).paint(learned, 115);
  for (int n = 0; n < 2000; ++n) {
    (void)vibe->apply(seen.luma(), &keep.mask(), fore.mask());
    ASSERT_EQ(test::count_all(fore.mask()), 0) << "within the radius";
  }
  seen.paint(kept, 130).paint(learned, 130);
  (void)vibe->apply(seen.luma(), &keep.mask(), fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), kept), 600) << "its samples are still those of the first frame";
  EXPECT_EQ(test::count_in(fore.mask(), learned), 0);
}

// A fish that was there in the first frame leaves a ghost; neighbours' values fill it unless it is kept.
TEST(Vibe, AGhostFadesButNotUnderKeep) {
  const int width = 130, height = 40;
  const Box ghost{20, 12, 36, 24}, kept_ghost{80, 12, 96, 24};
  auto vibe = vibe_for(width, height);
  Bits fore(width, height), keep(width, height);
  keep.paint(kept_ghost);
  Picture first(width, height, 100);
  first.paint(ghost, 180).paint(kept_ghost, 180);
  (void)vibe->apply(first.luma(), nullptr, fore.mask());
  (void)vibe->apply(Picture(width, height, 100).luma(), &keep.mask(), fore.mask());
  EXPECT_GE(test::count_in(fore.mask(), ghost), 14 * 10) << "its rim has samples from outside";
  for (int n = 0; n < 2000; ++n) (void)vibe->apply(Picture(width, height, 100).luma(), &keep.mask(), fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), ghost), 0);
  // The neighbours outside reach one pixel in.
  const Box inner{81, 13, 95, 23};
  EXPECT_EQ(test::count_in(fore.mask(), inner), 14 * 10);
}

std::vector<uint64_t> masks_of(uint64_t seed) {
  auto vibe = vibe_for(130, 30, 10, seed);
  Random random(9);
  Bits fore(130, 30);
  std::vector<uint64_t> all;
  for (int n = 0; n < 40; ++n) {
    (void)vibe->apply(Picture(130, 30, 100).noise(random, 9).luma(), nullptr, fore.mask());
    all.insert(all.end(), fore.words().begin(), fore.words().end());
  }
  return all;
}

Picture textured(int width, int height, float light = 1.0f) {
  Picture p(width, height);
  return p.each([&](int x, int y, int) { return light * static_cast<float>(80 + (x / 5 * 13 + y / 4 * 7) % 40); });
}

TEST(Vibe, ALampMultipliesWhatItKnowsSoThatNotOneFrameIsLost) {
  const int width = 130, height = 60;
  const Box fish{40, 20, 80, 32};
  for (const float lamp : {0.6f, 1.6f}) {
    auto vibe = vibe_for(width, height);
    Bits fore(width, height);
    for (int n = 0; n < 10; ++n) (void)vibe->apply(textured(width, height).luma(), nullptr, fore.mask());
    EXPECT_FALSE(vibe->relit());
    Picture lit = textured(width, height, lamp);
    (void)vibe->apply(lit.paint(fish, 230).luma(), nullptr, fore.mask());
    EXPECT_TRUE(vibe->relit());
    EXPECT_EQ(test::count_in(fore.mask(), fish), fish.width() * fish.height());
    EXPECT_EQ(test::count_all(fore.mask()), fish.width() * fish.height()) << lamp;
  }
}

// What lies under a fish of the first frame is drawn from the ground beside it, so that the fish is seen from the next frame
// on, and gone without a ghost when it leaves.
TEST(Vibe, WhatIsKeptInTheFirstFrameIsGuessedFromTheGround) {
  const int width = 200, height = 60;
  const Box fish{70, 20, 130, 36}, room{60, 14, 140, 42};
  auto vibe = vibe_for(width, height);
  Bits fore(width, height), keep(width, height);
  keep.paint(room);
  Random random(2);
  Picture with = textured(width, height);
  with.paint(fish, 200);
  const auto frame = [&](const Picture& p) { return Picture(p).noise(random, 2); };
  (void)vibe->apply(frame(with).luma(), &keep.mask(), fore.mask());
  (void)vibe->apply(frame(with).luma(), &keep.mask(), fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), fish), fish.width() * fish.height());
  EXPECT_LT(test::count_all(fore.mask()), fish.width() * fish.height() + 40);
  for (int n = 0; n < 2 * Vibe::kGuessFrames; ++n) (void)vibe->apply(frame(with).luma(), &keep.mask(), fore.mask());
  EXPECT_LT(test::count_all(fore.mask()), fish.width() * fish.height() + 10) << "ground between the fins is known now";
  (void)vibe->apply(frame(textured(width, height)).luma(), nullptr, fore.mask());
  EXPECT_LT(test::count_all(fore.mask()), 40);
}

TEST(Vibe, WhatWasSeenBeforeIsFamiliarThoughTheEstimateDiffers) {
  const int width = 130, height = 20;
  const Box vein{64, 5, 100, 9}, news{10, 5, 40, 9};
  auto vibe = vibe_for(width, height);
  Bits fore(width, height), differing(width, height);
  for (int n = 0; n < 900; ++n) {  // a light that passes every other frame
    Picture seen(width, height, 100);
    if (n % 2 == 0) seen.paint(vein, 118);
    (void)vibe->apply(seen.luma(), nullptr, fore.mask());
  }
  Picture seen(width, height, 100);
  seen.paint(vein, 118).paint(news, 118);
  differing.paint(vein).paint(news);
  vibe->clear_familiar({seen.luma().row(3) + 64, width - 64, 10, width}, 64, 3, 5,
                       {differing.mask().row(3) + 1, width - 64, 10, differing.mask().words_per_row});
  EXPECT_EQ(test::count_in(differing.mask(), vein), 0);
  EXPECT_EQ(test::count_in(differing.mask(), news), 30 * 4) << "outside the part that was asked for";
  vibe->clear_familiar(seen.luma(), 0, 0, 5, differing.mask());
  EXPECT_EQ(test::count_in(differing.mask(), news), 30 * 4);
}

TEST(Vibe, TheSeedDecidesTheMasks) {
  EXPECT_EQ(masks_of(7), masks_of(7));
  EXPECT_NE(masks_of(7), masks_of(8));
}

TEST(Vibe, WhatIsAbsorbedIsBackgroundAtOnce) {
  auto vibe = vibe_for(70, 9);
  Bits fore(70, 9);
  (void)vibe->apply(Picture(70, 9, 100).luma(), nullptr, fore.mask());
  Picture seen(70, 9, 100);
  seen.paint({60, 2, 70, 4}, 200).paint({10, 2, 20, 4}, 200);
  (void)vibe->apply(seen.luma(), nullptr, fore.mask());
  EXPECT_EQ(test::count_all(fore.mask()), 40);
  const nt::Run runs[] = {{2, 10, 20, 0}, {2, 60, 70, 1}, {3, 10, 20, 0}, {3, 60, 70, 1}};
  vibe->absorb(seen.luma(), runs, 1);
  (void)vibe->apply(seen.luma(), nullptr, fore.mask());
  EXPECT_EQ(test::count_in(fore.mask(), {10, 2, 20, 4}), 20) << "the other blob stays";
  EXPECT_EQ(test::count_all(fore.mask()), 20);
  EXPECT_EQ(vibe->estimate().row(3)[65], 200);
}

TEST(Vibe, RestartForgets) {
  auto vibe = vibe_for(65, 20);
  Bits fore(65, 20);
  for (int n = 0; n < 3; ++n) (void)vibe->apply(Picture(65, 20, 50).luma(), nullptr, fore.mask());
  vibe->restart();
  EXPECT_FALSE(vibe->apply(Picture(65, 20, 200).luma(), nullptr, fore.mask()));
  EXPECT_TRUE(vibe->apply(Picture(65, 20, 200).luma(), nullptr, fore.mask()));
  EXPECT_EQ(test::count_all(fore.mask()), 0);
  EXPECT_EQ(vibe->estimate().row(19)[64], 200);
}

TEST(Vibe, TooLittleMemoryGivesNullHoweverLittle) {
  Arena measure;
  (void)Vibe::create(measure, {}, 64, 10, 1);
  const test::Block block(measure.used());
  for (std::size_t bytes = 0; bytes < measure.used(); bytes += 64) {
    Arena arena(block.span().first(bytes));
    EXPECT_EQ(Vibe::create(arena, {}, 64, 10, 1), nullptr) << bytes;
  }
}

}  // namespace
}  // namespace nt
