// SPDX-License-Identifier: Apache-2.0
// 3D characters moved by their lattice over the tank's `turns`: no tetrahedron turns inside out, bones keep their lengths,
// the body its volume.
#include <gtest/gtest.h>

#include <memory>

#include "app/cast.h"
#include "app/session.h"
#include "platform/camera.h"

namespace nt {
namespace {

TEST(SwimmingLattice, SurvivesTheTurns) {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=turns,seed=1,size=480x272");
  options.background = parse_background("vibe");
  Session session(options);
  const std::vector<std::string> paths{NEONTETRA_ASSETS "/characters/whale.glb",
                                       NEONTETRA_ASSETS "/characters/lobster.glb"};
  const Wardrobe wardrobe(paths, {}, Deformer::lattice);
  std::vector<std::unique_ptr<Actor>> actors;
  for (std::size_t i = 0; i < wardrobe.size(); ++i) actors.push_back(std::make_unique<Actor>(wardrobe, i));
  const Pane pane = pane_for(480, 272);
  int poses = 0;
  Observer observer;
  for (int n = 0; n < 700 && session.step(); ++n) {
    const Sighting sighting = sighting_of(observer.look(session).of_target());
    poses += sighting.seen;
    for (std::size_t i = 0; i < actors.size(); ++i) {
      actors[i]->see(sighting);
      if (!sighting.seen) continue;
      actors[i]->pose(1, 1 / 30.0f, pane);
      ASSERT_NE(actors[i]->retarget().lattice(), nullptr);
      const LatticeQuality q = actors[i]->retarget().lattice()->lattice().quality();
      EXPECT_EQ(q.inverted, 0) << paths[i] << ", frame " << n;
      EXPECT_LT(q.bone_error_max, 1e-3f) << paths[i] << ", frame " << n;
      EXPECT_LT(q.rrms, 0.35f) << paths[i] << ", frame " << n;
    }
  }
  EXPECT_GT(poses, 500);
}

TEST(SwimmingLattice, FlatDrawingsHaveNone) {
  EXPECT_THROW(Wardrobe({NEONTETRA_ASSETS "/characters/carp.png"}, {}, Deformer::lattice), UserError);
  const Wardrobe mixed({NEONTETRA_ASSETS "/characters/carp.png", NEONTETRA_ASSETS "/characters/whale.glb"}, {},
                       Deformer::lattice);
  EXPECT_FALSE(mixed.character(0).lattice.present());
  EXPECT_TRUE(mixed.character(1).lattice.present());
}

}  // namespace
}  // namespace nt
