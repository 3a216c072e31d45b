// SPDX-License-Identifier: Apache-2.0
#include "app/actor.h"

#include <gtest/gtest.h>

#include "app/cast.h"
#include "app/session.h"

namespace nt {
namespace {

// The fish leaves and comes back elsewhere: the drawing must be there at once, not on its way.
TEST(Actor, AppearsWhereTheFishIsAfterAGap) {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=leave,seed=1,size=480x272");
  options.background = parse_background("vibe");
  Session session(options);
  const Wardrobe wardrobe({NEONTETRA_ASSETS "/characters/carp.png"}, {});
  Actor actor(wardrobe, 0);
  const Pane pane = pane_for(480, 272);
  bool seen = false;
  int missed = 0;
  Observer observer;
  for (int i = 0; i < 900 && session.step(); ++i) {
    actor.see(sighting_of(observer.look(session).of_target()));
    actor.pose(1, 1 / 30.0f, pane);
    const bool ok = session.report().status == PoseStatus::ok;
    if (ok && seen && missed > 15) {
      const Vec2 want = pane.to_scene(session.capture().motion().centre);
      EXPECT_LT(length(actor.retarget().control_points().centre - want), 0.5f);
      return;
    }
    seen = seen || ok;
    missed = ok ? 0 : missed + 1;
  }
  FAIL() << "the fish never came back";
}

}  // namespace
}  // namespace nt
