// SPDX-License-Identifier: Apache-2.0
// The bundled characters over the tank's `turns`: no triangle of a flat one turns over, all fins keep their area within a
// tenth.
#include <gtest/gtest.h>

#include <memory>

#include "app/cast.h"
#include "app/session.h"

namespace nt {
namespace {

TEST(BundledShapes, SurviveTheTurns) {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=turns,seed=1,size=480x272");
  options.background = parse_background("vibe");
  Session session(options);
  std::vector<std::string> paths;
  for (const std::string name :
       {"carp.png", "cartoon_fish.png", "mermaid.png", "flower.png", "whale.glb", "lobster.glb"})
    paths.push_back(NEONTETRA_ASSETS "/characters/" + name);
  const Wardrobe wardrobe(paths, {});
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
      const Distortion d = actors[i]->retarget().distortion();
      const bool flat = paths[i].ends_with(".png");
      EXPECT_EQ(flat ? d.inverted : 0, 0) << paths[i] << ", frame " << n;
      for (const float area : d.fin_area) EXPECT_NEAR(area, 1, 0.1f) << paths[i] << ", frame " << n;
    }
  }
  EXPECT_GT(poses, 500);
}

}  // namespace
}  // namespace nt
