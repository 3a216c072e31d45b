// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_scenes.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace nt {
namespace {

TEST(TankScenes, NamesAreUniqueAndFound) {
  std::set<std::string> seen;
  for (const std::string& name : tank_scene_names()) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    const TankScene* scene = find_tank_scene(name);
    ASSERT_NE(scene, nullptr) << name;
    EXPECT_EQ(name, scene->name);
    EXPECT_GT(std::string(scene->about).size(), 10u) << name;
  }
  for (const char* name : {"calm", "turns", "hover", "leave", "shadow", "night", "far", "near", "forked", "round",
                           "ghost", "station", "lamp", "surface", "dirt", "shake", "ring", "crossing", "long"})
    EXPECT_EQ(seen.count(name), 1u) << name;
  EXPECT_EQ(find_tank_scene("clam"), nullptr);
}

TEST(TankScenes, AnUnknownSceneIsNamedInTheError) {
  try {
    Tank tank({.scene = "clam"});
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'clam'"), std::string::npos) << error.what();
  }
}

TEST(TankScenes, SizesAndRatesThatMakeNoSenseAreRefused) {
  EXPECT_THROW(Tank({.width = 1, .height = 1}), std::invalid_argument);
  EXPECT_THROW(Tank({.width = 100000}), std::invalid_argument);
  EXPECT_THROW(Tank({.fps = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace nt
