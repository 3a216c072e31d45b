// SPDX-License-Identifier: Apache-2.0
#include "core/segment/target.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

// The blob of a filled ellipse that lies along x.
Blob ellipse(Vec2 centre, float rx, float ry) {
  Blob b;
  b.box = {static_cast<int>(centre.x - rx), static_cast<int>(centre.y - ry), static_cast<int>(centre.x + rx) + 1,
           static_cast<int>(centre.y + ry) + 1};
  b.area_px = static_cast<int>(det::kPi * rx * ry);
  b.centroid = centre;
  b.major_px = rx / 2, b.minor_px = ry / 2;
  return b;
}
Blob fish_at(float x, float y) { return ellipse({x, y}, 40, 10); }

using Scene = std::vector<Blob>;

// The target among the swimmers of one film.
struct Film {
  Swimmers swimmers;
  Target target;
  uint32_t before = 0;

  // The target's blob in this frame, -1 for none.
  int see(const Scene& scene) {
    before = target.id();
    swimmers.update(scene, {}, {});
    target.update(swimmers, scene);
    Swimmer* s = swimmers.find(target.id());
    if (s == nullptr) return -1;
    s->followed = true;
    return s->blob;
  }
  bool changed() const { return target.id() != before; }
  Swimmer& fish() { return *swimmers.find(target.id()); }
};

TEST(Target, NothingIsNobody) {
  Film film;
  for (int n = 0; n < 50; ++n) {
    EXPECT_EQ(film.see({}), -1);
    EXPECT_EQ(film.target.id(), 0u);
  }
}

TEST(Target, TheLargestFishShapedBlobIsTakenAtOnce) {
  Film film;
  const Scene scene{ellipse({50, 50}, 30, 8), fish_at(200, 80), ellipse({350, 150}, 45, 45)};
  EXPECT_EQ(film.see(scene), 1);
  EXPECT_TRUE(film.changed());
  EXPECT_EQ(film.see(scene), 1);
  EXPECT_FALSE(film.changed());
}

TEST(Target, WhatSwimsIsPreferredToWhatRests) {
  Film film;
  int chosen = -1;
  for (int n = 0; n < 30; ++n) {
    chosen = film.see({fish_at(100, 40), ellipse({100 + 5.0f * static_cast<float>(n), 150}, 34, 8)});
    if (n == 0) {
      EXPECT_EQ(chosen, 0) << "the larger one, while both rest";
    }
  }
  EXPECT_EQ(chosen, 1);
}

TEST(Target, IsLostForSoManyFramesAndThenStartsAnew) {
  Film film;
  film.swimmers.set_lost_after(5);
  EXPECT_EQ(film.see({fish_at(100, 100)}), 0);
  for (int n = 1; n <= 6; ++n) {
    EXPECT_EQ(film.see({}), -1) << n;
    EXPECT_NE(film.target.id(), 0u) << n;
  }
  (void)film.see({});
  EXPECT_EQ(film.target.id(), 0u);
  EXPECT_EQ(film.see({fish_at(400, 300)}), 0) << "whatever swims in";
}

TEST(Target, AfterALossItsLikeIsPreferred) {
  Film film;
  film.swimmers.set_lost_after(5);
  for (int n = 0; n < 40; ++n) EXPECT_EQ(film.see({fish_at(100 + 2.0f * static_cast<float>(n), 100)}), 0);
  for (int n = 0; n < 10; ++n) (void)film.see({});
  EXPECT_EQ(film.see({ellipse({300, 60}, 52, 13), fish_at(300, 200)}), 1) << "not the larger one";
}

TEST(Target, AClickSelectsTheBlobUnderIt) {
  Film film;
  const Scene scene{fish_at(100, 100), fish_at(300, 100), ellipse({300, 200}, 8, 8)};
  (void)film.see(scene);
  film.target.select_at({302, 203});
  EXPECT_EQ(film.see(scene), 2);
  EXPECT_TRUE(film.changed());
  for (int n = 0; n < 40; ++n) EXPECT_EQ(film.see(scene), 2) << "the user's choice stands";
  film.target.select_auto();
  EXPECT_NE(film.see(scene), 2);
}

TEST(Target, AClickIntoAnEmptyPictureWaitsForABlob) {
  Film film;
  film.target.select_at({300, 100});
  EXPECT_EQ(film.see({}), -1);
  EXPECT_EQ(film.see({fish_at(100, 100), fish_at(300, 100)}), 1);
}

TEST(Target, NextGoesRoundAllSwimmers) {
  Film film;
  const Scene scene{fish_at(300, 50), fish_at(100, 120), fish_at(500, 90)};
  film.target.select_at({300, 50});
  EXPECT_EQ(film.see(scene), 0);
  std::vector<int> order;
  for (int n = 0; n < 4; ++n) film.target.select_next(), order.push_back(film.see(scene));
  EXPECT_EQ(order, (std::vector<int>{2, 1, 0, 2}));
}

TEST(Target, AGhostIsNeverTheFish) {
  Film film;
  Scene scene{fish_at(100, 100)};
  scene[0].ghost = true;
  EXPECT_EQ(film.see(scene), -1);
}

TEST(Target, OneOddFrameDoesNotHandItOver) {
  Film film;
  for (int n = 0; n < 60; ++n) {
    const float x = 100 + 4.0f * static_cast<float>(n);
    const Blob odd = ellipse({x, 40}, 40, 38);  // two over each other
    EXPECT_EQ(film.see({n == 50 ? odd : fish_at(x, 40), ellipse({x, 160}, 36, 9)}), 0) << n;
  }
}

}  // namespace
}  // namespace nt
