// SPDX-License-Identifier: Apache-2.0
#include "core/segment/refine.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/segment/clean.h"
#include "core/segment/difference.h"
#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Bits;
using test::Picture;

class Refined {
 public:
  explicit Refined(const Limits& limits = {})
      : limits_(limits),
        refine_([this](Arena& arena) { return Refine::create(arena, limits_); }),
        blobs_([](Arena& arena) { return Blobs::create(arena, Limits{}); }) {}
  // The largest blob of what differs by more than `strong`, opened, as the pipeline does, then refined.
  FishMask operator()(const Picture& seen, const Picture& ground, int strong = 40, bool shadow = false,
                      float sigma = 1) {
    Bits raw(seen.width(), seen.height()), scratch(seen.width(), seen.height()), open(seen.width(), seen.height());
    mask_of_difference(seen.luma(), ground.luma(), strong, 0, raw.mask());
    open_mask(raw.mask(), scratch.mask(), open.mask(), 3);
    EXPECT_TRUE(blobs_->find(open.mask(), 1));
    int best = 0;
    for (int i = 0; i < static_cast<int>(blobs_->blobs().size()); ++i)
      if (area(i) > area(best)) best = i;
    EXPECT_FALSE(blobs_->blobs().empty());
    return refine_->fish(seen.luma(), ground.luma(), sigma, blobs_->blobs()[static_cast<std::size_t>(best)], best,
                         blobs_->runs(), shadow);
  }
  bool dropped() { return refine_->runs_dropped(); }

 private:
  int area(int i) { return blobs_->blobs()[static_cast<std::size_t>(i)].area_px; }
  Limits limits_;
  test::Made<std::function<Refine*(Arena&)>> refine_;
  test::Made<std::function<Blobs*(Arena&)>> blobs_;
};

bool in_fish(const FishMask& fish, int x, int y) { return fish.mask.at(x - fish.box.x0, y - fish.box.y0); }

TEST(Refine, TakesBackTheThinTailAndTheFaintFin) {
  Refined refined;
  const Picture ground(300, 150, 150);
  Picture seen = ground;
  seen.ellipse(150, 70, 40, 12, 60).paint({90, 70, 112, 71}, 60).paint({140, 80, 150, 95}, 125);
  seen.paint({20, 120, 30, 124}, 60);  // something else
  const FishMask fish = refined(seen, ground);
  for (int y = 0; y < 115; ++y)
    for (int x = 40; x < 260; ++x) ASSERT_EQ(in_fish(fish, x, y), seen.at(x, y) != 150) << x << " " << y;
  EXPECT_FALSE(in_fish(fish, 25, 122)) << "what does not hang together with the blob";
  EXPECT_FALSE(fish.shadow_removed);
  EXPECT_FALSE(refined.dropped());
}

TEST(Refine, AroundIsTheFishGrown) {
  Refined refined;
  const Picture ground(300, 150, 150);
  Picture seen = ground;
  seen.ellipse(150, 70, 40, 12, 60);
  const FishMask fish = refined(seen, ground);
  const auto around = [&](int x, int y) { return fish.around.at(x - fish.box.x0, y - fish.box.y0); };
  EXPECT_TRUE(around(150, 70 + 12 + 4));
  EXPECT_FALSE(around(150, 70 + 12 + 10));
  EXPECT_TRUE(around(150 - 40 - 4, 70));
  EXPECT_FALSE(around(150 - 40 - 10, 70));
  EXPECT_EQ(fish.box.x0 % 64, 0) << "its words are words of the frame";
}

TEST(Refine, GrowsTheBoxWhereTheFishReachesFarther) {
  Refined refined;
  const Picture ground(400, 100, 150);
  Picture seen = ground;
  seen.paint({180, 40, 200, 60}, 40).paint({70, 46, 330, 54}, 125);
  const FishMask fish = refined(seen, ground);
  EXPECT_TRUE(in_fish(fish, 72, 50) && in_fish(fish, 328, 50));
}

TEST(Refine, AShadowBesideABrightFishIsTakenAway) {
  Refined refined;
  const Picture ground(300, 150, 120);
  Picture seen = ground;
  seen.ellipse(150, 80, 42, 14, 90).ellipse(145, 70, 40, 12, 230);
  const FishMask kept = refined(seen, ground, 20, false);
  EXPECT_TRUE(in_fish(kept, 150, 91));
  const FishMask fish = refined(seen, ground, 20, true);
  EXPECT_TRUE(fish.shadow_removed);
  EXPECT_FALSE(in_fish(fish, 150, 91));
  EXPECT_TRUE(in_fish(fish, 145, 70));
}

TEST(Refine, TinyFramesAndCorners) {
  Refined refined;
  const Picture ground(16, 16, 100);
  Picture seen = ground;
  seen.paint({0, 0, 6, 3}, 200);
  const FishMask fish = refined(seen, ground);
  EXPECT_EQ(test::count_all(fish.mask), 18);
  EXPECT_LE(fish.box.x1, 16);
  EXPECT_LE(fish.box.y1, 16);
}

TEST(Refine, TooFewRunsAreSaid) {
  Limits limits;
  limits.max_runs = 5;
  Refined refined(limits);
  const Picture ground(300, 150, 150);
  Picture seen = ground;
  (void)refined(seen.ellipse(150, 70, 40, 12, 60), ground);
  EXPECT_TRUE(refined.dropped());
}

}  // namespace
}  // namespace nt
