// SPDX-License-Identifier: Apache-2.0
// The stabiliser over the simulated tank, whose camera's motion is known.
#include "core/stabilise/stabiliser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "platform/sim/tank.h"
#include "platform/sim/tank_hand.h"
#include "tests/support/block.h"

namespace {

using nt::Stabilise;

class Film {
 public:
  Film(const std::string& scene, Stabilise mode, int width = 320, int height = 180)
      : settings_{.scene = scene, .seed = 2, .width = width, .height = height},
        tank_(settings_),
        hand_(*nt::find_tank_scene(scene), 2, width, height),
        block_(bytes(mode, width, height)),
        arena_(block_.span()),
        stabiliser(nt::Stabiliser::create(arena_, mode, width, height)) {}
  nt::Stabilised next() { return stabiliser->apply(tank_.render_next(), {}); }
  void skip(int frames) {
    for (int n = 0; n < frames; ++n) tank_.render_next();
  }
  // The largest error at the frame's corners, pixels.
  float error(const nt::Similarity& found) const {
    const auto at = [&](int64_t n) { return hand_.frame_from_tank(static_cast<double>(n) / settings_.fps); };
    const nt::tank::Similarity to = at(tank_.frame_index()), back = at(0).inverse();
    const auto right = static_cast<float>(settings_.width - 1), bottom = static_cast<float>(settings_.height - 1);
    float worst = 0;
    for (const nt::Vec2 p : {nt::Vec2{0, 0}, nt::Vec2{right, 0}, nt::Vec2{0, bottom}, nt::Vec2{right, bottom}})
      worst = std::max(worst, nt::length(to(back(p)) - found(p)));
    return worst;
  }

 private:
  static std::size_t bytes(Stabilise mode, int width, int height) {
    nt::Arena measure;
    nt::Stabiliser::create(measure, mode, width, height);
    return measure.used();
  }
  nt::TankSettings settings_;
  nt::Tank tank_;
  nt::tank::Hand hand_;
  nt::test::Block block_;
  nt::Arena arena_;

 public:
  nt::Stabiliser* stabiliser;
};

TEST(Stabiliser, FollowsAHandToHalfAPixel) {
  Film film("shake", Stabilise::on);
  float worst = 0, sum = 0;
  for (int n = 0; n < 300; ++n) {
    const nt::Stabilised seen = film.next();
    ASSERT_FALSE(seen.lost) << n;
    EXPECT_TRUE(seen.moved);
    const float error = film.error(seen.frame_from_reference);
    worst = std::max(worst, error), sum += error;
  }
  EXPECT_LT(worst, 0.5f);
  EXPECT_LT(sum / 300, 0.15f);
}

TEST(Stabiliser, OffIsNothing) {
  nt::Arena measure;
  EXPECT_EQ(nt::Stabiliser::create(measure, Stabilise::off, 960, 544), nullptr);
  EXPECT_EQ(measure.used(), 0u);
}

TEST(Stabiliser, AutomaticLeavesAStillCameraAlone) {
  for (const char* scene : {"calm", "lamp", "surface", "dirt", "near", "crossing", "night"}) {
    Film film(scene, Stabilise::automatic);
    for (int n = 0; n < 250; ++n) {
      const nt::Stabilised seen = film.next();
      ASSERT_FALSE(seen.moved || seen.lost || film.stabiliser->active()) << scene << " " << n;
      ASSERT_NE(seen.luma.data, nullptr);
    }
  }
}

TEST(Stabiliser, AutomaticSwitchesItselfOn) {
  Film film("shake", Stabilise::automatic);
  int first = -1;
  for (int n = 0; n < 60 && first < 0; ++n)
    if (film.next().moved) first = n;
  EXPECT_GE(first, 1);
  EXPECT_LE(first, 15);
  EXPECT_TRUE(film.stabiliser->active());
}

TEST(Stabiliser, AJoltIsFollowed) {
  Film film("shake", Stabilise::on);
  for (int n = 0; n < 30; ++n) film.next();
  film.skip(20);  // two thirds of a second pass: several pixels at once
  const nt::Stabilised seen = film.next();
  EXPECT_FALSE(seen.lost);
  EXPECT_LT(film.error(seen.frame_from_reference), 0.5f);
}

TEST(Stabiliser, AnotherViewIsMarkedAndThenTheNewReference) {
  Film film("calm", Stabilise::on);
  film.next();
  Film elsewhere("dirt", Stabilise::on);
  nt::Tank other({.scene = "calm", .seed = 77, .width = 320, .height = 180});
  int lost = 0;
  nt::Stabilised seen;
  for (int n = 0; n < 10 && !seen.renewed; ++n) {
    seen = film.stabiliser->apply(other.render_next(), {});
    lost += seen.lost;
  }
  EXPECT_TRUE(seen.renewed);
  EXPECT_GE(lost, 2);
  const nt::Stabilised after = film.stabiliser->apply(other.render_next(), {});
  EXPECT_FALSE(after.lost);
  EXPECT_TRUE(after.moved);
}

TEST(Stabiliser, WithoutTextureFramesAreHandedThrough) {
  Film film("calm", Stabilise::on);
  film.stabiliser->restart();
  const std::vector<uint8_t> plain(320 * 180, 120);
  const nt::Stabilised seen = film.stabiliser->apply({plain.data(), 320, 180, 320}, {});
  EXPECT_TRUE(film.stabiliser->blind());
  EXPECT_FALSE(seen.moved || seen.lost);
  EXPECT_EQ(seen.luma.data, plain.data());
}

}  // namespace
