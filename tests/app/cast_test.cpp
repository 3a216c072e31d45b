// SPDX-License-Identifier: Apache-2.0
#include "app/cast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/ui/backdrop.h"
#include "platform/linux/heap_count.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";

CaptureOptions tank(const std::string& more = "") {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=turns,seed=1,size=480x272" + more);
  options.background = parse_background("vibe");
  return options;
}

CastOptions cast_of(std::vector<std::string> characters, int school = 1) {
  CastOptions options;
  options.characters = std::move(characters);
  options.school = school;
  return options;
}

int meshes(const Scene& scene) {
  int count = 0;
  for (const SceneItem& item : scene.items()) count += item.kind == ItemKind::mesh ? 1 : 0;
  return count;
}

Vec2 mean(std::span<const Vec2> points) {
  Vec2 sum;
  for (const Vec2 p : points) sum += p;
  return sum * (1.0f / static_cast<float>(points.size()));
}

TEST(Cast, ASchoolFollowsOneAfterTheOtherAndKeepsApart) {
  Session session(tank());
  Observer observer;
  Cast cast(cast_of({kCarp}, 4), session);
  const Pane pane = pane_for(480, 272);
  int first_seen[5] = {-1, -1, -1, -1, -1};
  Scene scene;
  for (int n = 0; n < 200 && session.step(); ++n) {
    cast.see(observer.look(session));
    cast.pose(1, 1 / 30.0f, pane);
    scene.clear(pane.width, pane.height, kWater);
    cast.draw(scene);
    const int shown = meshes(scene);
    ASSERT_LE(shown, 4);
    if (first_seen[shown] < 0) first_seen[shown] = n;
  }
  for (int k = 2; k <= 4; ++k) EXPECT_EQ(first_seen[k] - first_seen[k - 1], 4) << k;  // 0.12 s of 30 frames a second
  ASSERT_EQ(meshes(scene), 4);
  const auto items = scene.items();
  const Vec2 leader = mean(items.back().positions);  // drawn last, on top
  for (int i = 0; i < 3; ++i) EXPECT_GT(length(mean(items[static_cast<std::size_t>(i)].positions) - leader), 30) << i;
}

TEST(Cast, EveryFishHasItsDrawing) {
  CaptureOptions options = tank();
  options.camera = parse_camera_spec("sim:scene=crossing,seed=1,size=480x272");
  options.max_fish = 2;
  Session session(options);
  Observer observer;
  Cast cast(cast_of({kCarp, kCarp}), session);
  const Pane pane = pane_for(480, 272);
  int most = 0;
  for (int n = 0; n < 300 && most < 2 && session.step(); ++n) {
    cast.see(observer.look(session));
    cast.pose(1, 1 / 30.0f, pane);
    Scene scene;
    scene.clear(pane.width, pane.height, kWater);
    cast.draw(scene);
    most = std::max(most, meshes(scene));
    if (most < 2) continue;
    EXPECT_NE(scene.items()[0].picture.id, scene.items()[1].picture.id);
    EXPECT_GT(length(mean(scene.items()[0].positions) - mean(scene.items()[1].positions)), 20);
  }
  EXPECT_EQ(most, 2);
}

TEST(Cast, TheNextCharacterTakesOverInPlace) {
  Session session(tank());
  Observer observer;
  Cast cast(cast_of({kCarp, kCarp}), session);
  const Pane pane = pane_for(480, 272);
  while (!cast.leader().seen() && session.step()) cast.see(observer.look(session));
  for (int n = 0; n < 10 && session.step(); ++n) {
    cast.see(observer.look(session));
    cast.pose(1, 1 / 30.0f, pane);
  }
  const Vec2 before = mean(cast.leader().retarget().vertices());
  EXPECT_EQ(cast.leader().costume(), 0u);
  cast.next_character();
  EXPECT_EQ(cast.leader().costume(), 1u);
  Scene scene;
  scene.clear(pane.width, pane.height, kWater);
  cast.pose(1, 1 / 60.0f, pane);
  cast.draw(scene);
  ASSERT_EQ(meshes(scene), 1);
  EXPECT_EQ(scene.items()[0].picture.id, kFirstCharacterPicture + 1u);
  EXPECT_LT(length(mean(scene.items()[0].positions) - before), 5);
  cast.next_character();
  EXPECT_EQ(cast.leader().costume(), 0u);
}

TEST(Cast, NothingIsAllocatedAfterTheFirstFrame) {
  if (!heap_count_available()) GTEST_SKIP() << "allocations cannot be counted in this build";
  Session session(tank());
  Observer observer;
  Cast cast(cast_of({kCarp, kCarp}, 3), session);
  const Pane pane = pane_for(480, 272);
  Backdrop backdrop({BackdropOption::Kind::camera, kWater, ""}, pane, session);
  Scene scene;
  int64_t allocations = 0;
  for (int n = 0; n < 150 && session.step(); ++n) {
    (void)session.camera().picture();  // may make the picture: the camera's business
    const HeapCount heap;
    cast.see(observer.look(session));
    backdrop.update(observer.look(session, true, true));
    if (n % 40 == 20) cast.next_character();
    for (const float t : {0.5f, 1.0f}) cast.pose(t, 1 / 60.0f, pane);
    scene.clear(pane.width, pane.height, backdrop.colour());
    backdrop.draw(scene);
    cast.draw(scene);
    if (n > 0) allocations += heap.allocations();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(meshes(scene), 3);
}

}  // namespace
}  // namespace nt
