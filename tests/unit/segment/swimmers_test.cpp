// SPDX-License-Identifier: Apache-2.0
#include "core/segment/swimmers.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/det_math.h"
#include "tests/support/picture.h"

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

// Straight on from a place, one step a frame.
struct Course {
  Vec2 from, step;
  float size = 1;
  Blob at(int n) const { return ellipse(from + step * static_cast<float>(n), 40 * size, 10 * size); }
};

// Two fish in one blob.
Blob heap_of(const Blob& a, const Blob& b) {
  Blob heap = a;
  heap.box = {min_int(a.box.x0, b.box.x0), min_int(a.box.y0, b.box.y0), max_int(a.box.x1, b.box.x1),
              max_int(a.box.y1, b.box.y1)};
  heap.area_px = (a.area_px + b.area_px) * 9 / 10;
  heap.centroid = (a.centroid + b.centroid) * 0.5f;
  heap.major_px *= 1.2f, heap.minor_px *= 1.5f;
  return heap;
}

bool touch(const Blob& a, const Blob& b) {
  return a.box.x0 < b.box.x1 && b.box.x0 < a.box.x1 && a.box.y0 < b.box.y1 && b.box.y0 < a.box.y1;
}

TEST(Swimmers, LikenessIsThatOfALongFilledWholeBlob) {
  const Blob fish = fish_at(100, 100);
  EXPECT_GT(fish_likeness(fish), 0.9f);
  EXPECT_LT(fish_likeness(ellipse({100, 100}, 20, 20)), 0.2f);
  Blob crack = fish, cut = fish, ghost = fish;
  crack.area_px /= 3, cut.touches_edge = true, ghost.ghost = true;
  EXPECT_LT(fish_likeness(crack), 0.2f);
  EXPECT_LT(fish_likeness(cut), 0.5f * fish_likeness(fish));
  EXPECT_EQ(fish_likeness(ghost), 0);
  Blob dot;
  dot.area_px = 1;
  EXPECT_GE(fish_likeness(dot), 0);
}

TEST(Swimmers, LooksAreUnlikeBySizeAndBrightness) {
  const Looks fish{1000, 100, 120};
  EXPECT_NEAR(fish.unlike(fish), 0, 1e-6f);
  EXPECT_GT(fish.unlike({720, 85, 120}), 0.3f) << "15 % shorter";
  EXPECT_FLOAT_EQ(fish.unlike({720, 85, 120}), Looks({720, 85, 120}).unlike(fish));
  EXPECT_GT(fish.unlike({1000, 100, 160}), 0.4f);
  EXPECT_NEAR(fish.unlike({1000, 100, 0}), 0, 1e-6f) << "brightness not known";
  EXPECT_GE(Looks{}.unlike(fish), 0);
}

TEST(Swimmers, EachKeepsItsIdentityWhereTheyPass) {
  Swimmers swimmers;
  uint32_t ids[2] = {};
  for (int n = 0; n < 60; ++n) {
    const Scene scene{Course{{420, 130}, {-4, 0}}.at(n), Course{{100, 100}, {4, 0}}.at(n)};
    swimmers.update(scene, {}, {});
    for (int i = 0; i < 2; ++i) {
      const Swimmer* s = swimmers.of_blob(i, {});
      ASSERT_NE(s, nullptr) << n;
      if (n == 0) ids[i] = s->id;
      ASSERT_EQ(s->id, ids[i]) << n;
      ASSERT_FALSE(s->in_heap);
    }
  }
  EXPECT_NEAR(swimmers.find(ids[1])->velocity.x, 4, 0.1f);
  EXPECT_EQ(swimmers.all().size(), 2u);
}

// Two that swim over each other; returns whether both come out as who they were.
bool told_apart(const Course& first, const Course& second, int frames, int& heap_frames) {
  Swimmers swimmers;
  uint32_t one = 0, two = 0;
  for (int n = 0; n < frames; ++n) {
    const Blob a = first.at(n), b = second.at(n);
    const bool heap = touch(a, b);
    heap_frames += heap;
    swimmers.update(heap ? Scene{heap_of(a, b)} : Scene{a, b}, {}, {});
    if (n == 0) one = swimmers.of_blob(0, {})->id, two = swimmers.of_blob(1, {})->id;
    if (heap && n > 0) {
      for (const uint32_t id : {one, two}) {
        EXPECT_TRUE(swimmers.find(id)->in_heap) << n;
        EXPECT_EQ(swimmers.find(id)->blob, 0) << n;
      }
    }
  }
  EXPECT_EQ(swimmers.all().size(), 2u) << "nobody else came out";
  return swimmers.find(one)->blob == 0 && swimmers.find(two)->blob == 1;
}

TEST(Swimmers, ThoseThatCrossComeOutAsWhoTheyWere) {
  int heap_frames = 0;
  EXPECT_TRUE(told_apart({{100, 100}, {5, 0}}, {{420, 180}, {-5, -2}}, 60, heap_frames));
  EXPECT_GT(heap_frames, 8);
  EXPECT_TRUE(told_apart({{100, 100}, {5, 0}}, {{260, 20}, {0, 4}}, 60, heap_frames)) << "at right angles";
}

TEST(Swimmers, WhereOneTurnsBackInTheHeapSizeTells) {
  // They meet and part again to where they came from: by motion alone they would be swapped.
  Swimmers swimmers;
  const Course large{{100, 100}, {4, 0}, 1.2f}, small{{380, 100}, {-4, 0}, 0.85f};
  const auto there = [](int n) { return n < 30 ? n : 60 - n; };
  uint32_t one = 0;
  for (int n = 0; n < 60; ++n) {
    const Blob a = large.at(there(n)), b = small.at(there(n));
    swimmers.update(touch(a, b) ? Scene{heap_of(a, b)} : Scene{a, b}, {}, {});
    if (n == 0) one = swimmers.of_blob(0, {})->id;
  }
  EXPECT_EQ(swimmers.find(one)->blob, 0);
  EXPECT_EQ(swimmers.all().size(), 2u);
}

TEST(Swimmers, AFinThatWasABlobOfItsOwnMakesNoHeap) {
  Swimmers swimmers;
  for (int n = 0; n < 40; ++n) {
    const float x = 100 + 3.0f * static_cast<float>(n);
    Scene scene{fish_at(x, 100)};
    if (n < 20) scene.push_back(ellipse({x - 60, 100}, 8, 5));
    swimmers.update(scene, {}, {});
    EXPECT_FALSE(swimmers.of_blob(0, {x, 100})->in_heap) << n;
  }
}

TEST(Swimmers, AHeapThatIsNoLargerThanOneFishShowsThatOne) {
  Swimmers swimmers;
  const Course first{{100, 100}, {4, 0}}, second{{300, 100}, {-4, 0}};
  uint32_t one = 0;
  for (int n = 0; n < 60; ++n) {
    const Blob a = first.at(n), b = second.at(n);
    // The second one dives under the first and is gone.
    swimmers.update(touch(a, b) || n > 20 ? Scene{a} : Scene{a, b}, {}, {});
    if (n == 0) one = swimmers.of_blob(0, {})->id;
  }
  EXPECT_EQ(swimmers.find(one)->blob, 0);
  EXPECT_FALSE(swimmers.find(one)->in_heap);
}

TEST(Swimmers, ReturnsAfterAShortGapAndIsForgottenAfterALongOne) {
  for (const bool followed : {true, false}) {
    Swimmers swimmers;
    swimmers.set_lost_after(10);
    const Scene scene{fish_at(100, 100)};
    swimmers.update(scene, {}, {});
    const uint32_t id = swimmers.all()[0].id;
    swimmers.all()[0].followed = followed;
    for (int n = 0; n < 3; ++n) swimmers.update({}, {}, {});
    swimmers.update(scene, {}, {});
    ASSERT_NE(swimmers.find(id), nullptr);
    EXPECT_EQ(swimmers.find(id)->blob, 0);
    EXPECT_EQ(swimmers.find(id)->lost_frames, 0);
    for (int n = 0; n < 8; ++n) swimmers.update({}, {}, {});
    EXPECT_EQ(swimmers.find(id) != nullptr, followed);
    for (int n = 0; n < 8; ++n) swimmers.update({}, {}, {});
    EXPECT_EQ(swimmers.find(id), nullptr);
  }
}

TEST(Swimmers, MoreThanThereIsRoomForAreTheLeastFishLike) {
  Swimmers swimmers;
  Scene scene;
  for (int i = 0; i < 40; ++i) scene.push_back(ellipse({static_cast<float>(20 * i), 400}, 5, 5));
  swimmers.update(scene, {}, {});
  EXPECT_EQ(swimmers.all().size(), static_cast<std::size_t>(Swimmers::kMostSwimmers));
  scene.push_back(fish_at(300, 100));
  swimmers.update(scene, {}, {});
  EXPECT_NE(swimmers.of_blob(40, {}), nullptr);
  EXPECT_EQ(swimmers.all().size(), static_cast<std::size_t>(Swimmers::kMostSwimmers));
}

TEST(Swimmers, WhatIsTooLargeIsNobody) {
  Swimmers swimmers;
  swimmers.set_largest(2000);
  const Scene scene{ellipse({100, 100}, 60, 15), fish_at(300, 100)};
  swimmers.update(scene, {}, {});
  EXPECT_EQ(swimmers.of_blob(0, {}), nullptr);
  EXPECT_NE(swimmers.of_blob(1, {}), nullptr);
}

TEST(Swimmers, BrightnessIsLearnedWhereThereAreTwo) {
  test::Picture picture(400, 200, 90);
  picture.paint({0, 0, 200, 200}, 150);
  Scene scene{fish_at(100, 100), fish_at(300, 100)};
  std::vector<nt::Run> runs;
  for (int y = 92; y < 108; ++y) {
    runs.push_back({static_cast<int16_t>(y), 60, 140, 0});
    runs.push_back({static_cast<int16_t>(y), 260, 340, 1});
  }
  Swimmers swimmers;
  for (int n = 0; n < 3; ++n) swimmers.update(scene, runs, picture.luma());
  EXPECT_NEAR(swimmers.of_blob(0, {})->looks.luma, 150, 1);
  EXPECT_NEAR(swimmers.of_blob(1, {})->looks.luma, 90, 1);
}

TEST(Swimmers, AnOutlineThatSuddenlyEnclosesMuchMoreIsAMergedOne) {
  Swimmers swimmers;
  const Scene scene{fish_at(100, 100)};
  const auto observe = [&](float area_px, float axis_px, bool touching) {
    swimmers.update(scene, {}, {});
    return swimmers.all()[0].observe(scene[0].box, scene[0].centroid, area_px, axis_px, touching, 4);
  };
  for (int n = 0; n < 5; ++n) EXPECT_TRUE(observe(1250, 100, false));
  EXPECT_FALSE(observe(1700, 100, true)) << "fins do not open that far while another one touches it";
  EXPECT_TRUE(observe(1600, 100, false)) << "fins that opened";
  for (int n = 0; n < 4; ++n) EXPECT_FALSE(observe(2800, 100, false));
  EXPECT_TRUE(observe(2800, 100, false)) << "it stays so: this is the fish now";
  EXPECT_FALSE(observe(2800, 50, false)) << "half the axis: closed into a ring";
}

TEST(Swimmers, AFirstOutlineInPartGrowsWithItsBlob) {
  Swimmers swimmers;
  const auto observe = [&](const Blob& blob, float area_px, float axis_px) {
    swimmers.update(Scene{blob}, {}, {});
    return swimmers.all()[0].observe(blob.box, blob.centroid, area_px, axis_px, false, 30);
  };
  EXPECT_TRUE(observe(ellipse({60, 100}, 18, 10), 500, 30));
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(observe(fish_at(60, 100), 1300, 80)) << n;
}

TEST(Swimmers, WhatCannotBeToldSwimsOnInsideItsBlob) {
  Swimmers swimmers;
  const auto observe = [&](const Blob& blob, float area_px) {
    swimmers.update(Scene{blob}, {}, {});
    return swimmers.all()[0].observe(blob.box, blob.centroid, area_px, 80, false, 30);
  };
  for (int n = 0; n < 8; ++n) observe(fish_at(100 + 30.0f * static_cast<float>(n), 100), 1250);
  const Blob held = fish_at(310, 100);
  for (int n = 0; n < 8; ++n) {
    EXPECT_FALSE(observe(held, 4000));
    EXPECT_LE(swimmers.all()[0].centroid.x, static_cast<float>(held.box.x1)) << n;
  }
}

TEST(Swimmers, AFinThatSwimsInBesideItsFishIsAPartOfIt) {
  Swimmers swimmers;
  for (int n = 0; n < 10; ++n) swimmers.update(Scene{fish_at(60, 100)}, {}, {});
  const uint32_t fish = swimmers.all()[0].id;
  swimmers.update(Scene{fish_at(60, 100), ellipse({50, 130}, 10, 5)}, {}, {});
  ASSERT_EQ(swimmers.all().size(), 2u);
  EXPECT_EQ(swimmers.all()[1].part_of, fish);
  swimmers.update(Scene{fish_at(60, 100), ellipse({50, 130}, 10, 5), ellipse({300, 100}, 10, 5)}, {}, {});
  ASSERT_EQ(swimmers.all().size(), 3u);
  EXPECT_EQ(swimmers.all()[2].part_of, 0u) << "farther away than the fish is long";
}

}  // namespace
}  // namespace nt
