// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/drag.h"

#include <gtest/gtest.h>

#include "app/author/character_lattice.h"
#include "app/wardrobe.h"

namespace nt {
namespace {

class DragTest : public ::testing::Test {
 protected:
  DragTest() : wardrobe_({NEONTETRA_ASSETS "/characters/whale.glb"}, {}, Deformer::lattice) {}
  const Character& whale() const { return wardrobe_.character(0); }
  static void send(Drag& drag, InputEvent::Kind kind, Vec2 at, int key = 0) {
    InputEvent event;
    event.kind = kind, event.at = at, event.key = key;
    drag.handle(event);
  }
  // Presses, moves in steps as a hand does, lets go, and lets it settle.
  static void pull(Drag& drag, Vec2 from, Vec2 to) {
    send(drag, InputEvent::Kind::click, from);
    for (int k = 1; k <= 20; ++k) {
      send(drag, InputEvent::Kind::move, lerp(from, to, static_cast<float>(k) / 20));
      EXPECT_EQ(drag.step().inverted, 0);
    }
    send(drag, InputEvent::Kind::release, to);
    for (int k = 0; k < 30; ++k) drag.step();
  }
  static Vec2 joint(const Drag& drag, const Character& c, std::size_t j) {
    return drag.to_scene(drag.lattice().vertices()[c.lattice.view.skeleton.vertex[j]]);
  }
  Wardrobe wardrobe_;
};

TEST_F(DragTest, TheBodyFollowsOnePinAndBendsByTwo) {
  Drag drag(whale(), 640, 480);
  const std::size_t head = static_cast<std::size_t>(whale().u_num) + 1,
                    tail = whale().lattice.view.skeleton.joints() - 1;
  const Vec2 head_at = joint(drag, whale(), head), tail_at = joint(drag, whale(), tail);
  pull(drag, head_at, head_at + Vec2{30, -20});
  EXPECT_EQ(drag.pins(), 1u);
  EXPECT_LT(length(joint(drag, whale(), head) - (head_at + Vec2{30, -20})), 3);
  EXPECT_LT(length(joint(drag, whale(), tail) - (tail_at + Vec2{30, -20})), 25);
  const Vec2 tail_now = joint(drag, whale(), tail);
  const Vec2 away = right_of(normalised(tail_now - joint(drag, whale(), head))) * 70.0f;
  pull(drag, tail_now, tail_now + away);
  EXPECT_EQ(drag.pins(), 2u);
  EXPECT_LT(length(joint(drag, whale(), tail) - (tail_now + away)), 12);
  EXPECT_LT(length(joint(drag, whale(), head) - (head_at + Vec2{30, -20})), 12);
  const LatticeQuality q = drag.lattice().quality();
  EXPECT_EQ(q.inverted, 0);
  EXPECT_LT(q.bone_error_max, 1e-3f);
}

TEST_F(DragTest, PinsAreTakenUpAgainAndGo) {
  Drag drag(whale(), 640, 480);
  const Vec2 at = drag.to_scene(drag.vertex(100));
  pull(drag, at, at + Vec2{15, 0});
  pull(drag, at + Vec2{15, 0}, at + Vec2{40, 10});
  EXPECT_EQ(drag.pins(), 1u) << "the same pin";
  send(drag, InputEvent::Kind::click, {2, 2});
  EXPECT_EQ(drag.pins(), 1u) << "nothing is there";
  send(drag, InputEvent::Kind::key, {}, 'u');
  EXPECT_EQ(drag.pins(), 0u);
  EXPECT_TRUE(drag.step().held);
  for (int k = 0; k < 20; ++k) pull(drag, drag.to_scene(drag.vertex(37u * static_cast<std::size_t>(k))), {320, 240});
  EXPECT_LE(drag.pins(), Drag::kMostPins);
  send(drag, InputEvent::Kind::key, {}, 'x');
  EXPECT_EQ(drag.pins(), 0u);
  Scene scene;
  drag.draw(scene);
  EXPECT_EQ(scene.items().size(), 3u);
}

}  // namespace
}  // namespace nt
