// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_water.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nt::tank {
namespace {

Canvas flat(int width, int height, int16_t light = 1600) {
  Canvas canvas{width, height, (width + 31) / 32 * 32, {}};
  canvas.light.assign(static_cast<std::size_t>(canvas.stride) * height, light);
  return canvas;
}

double mean_of(Canvas& canvas) {
  double sum = 0;
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) sum += canvas.row(y)[x];
  return sum / canvas.width / canvas.height;
}

TEST(TankWater, ASceneThatAsksForNothingLeavesThePictureAlone) {
  const TankScene& calm = *find_tank_scene("calm");
  Canvas canvas = flat(320, 180);
  SurfaceLight(calm, 1, 320).apply(1.0, canvas);
  WallMirror(calm, 320).apply(std::vector<uint8_t>(canvas.light.size()), canvas);
  Drifters(calm, 1, 320, 180).draw(1.0, canvas);
  Lamps(calm).apply(1.0, canvas);
  EXPECT_TRUE(Lamps(calm).steady());
  EXPECT_EQ(canvas.light, flat(320, 180).light);
}

TEST(TankWater, CausticsAreABrightNetworkThatMovesAndKeepsTheMeanLight) {
  const SurfaceLight surface(*find_tank_scene("surface"), 1, 960);
  Canvas now = flat(960, 544), soon = now, later = now;
  surface.apply(10.0, now);
  surface.apply(10.0 + 1.0 / 30, soon);
  surface.apply(12.0, later);
  EXPECT_NEAR(mean_of(now), 1600, 40);
  EXPECT_NEAR(mean_of(later), mean_of(now), 40);
  double spread = 0, step = 0, change = 0;
  int bright = 0;
  for (int y = 0; y < 544; ++y)
    for (int x = 0; x < 960; ++x) {
      spread += std::pow(now.row(y)[x] - 1600, 2);
      step += std::pow(now.row(y)[x] - soon.row(y)[x], 2);
      change += std::pow(now.row(y)[x] - later.row(y)[x], 2);
      bright += now.row(y)[x] > 1900;
    }
  EXPECT_GT(bright, 544 * 960 / 100);  // lines, not a veil
  EXPECT_LT(bright, 544 * 960 / 8);
  EXPECT_LT(step, 0.2 * spread);  // slowly
  EXPECT_GT(change, 0.5 * spread);
}

TEST(TankWater, BubblesRiseAndNothingRunsOutInAnHour) {
  const TankScene& dirt = *find_tank_scene("dirt");
  TankScene bubbles = dirt;
  bubbles.particles = 0;
  const auto touched = [](const Drifters& drifters, double t_s) {
    Canvas canvas = flat(960, 544, 200);
    drifters.draw(t_s, canvas);
    int count = 0;
    for (int16_t v : canvas.light) count += v != 200;
    return count;
  };
  for (double t_s : {0.0, 5.0, 3600.0}) {
    EXPECT_GT(touched(Drifters(bubbles, 1, 960, 544), t_s), 300) << t_s;
    EXPECT_GT(touched(Drifters(dirt, 1, 960, 544), t_s), 600) << t_s;
    EXPECT_LT(touched(Drifters(dirt, 1, 960, 544), t_s), 12000) << t_s;
  }
  // One bubble alone: what it brightens moves up the frame.
  bubbles.bubbles = 1;
  const Drifters one(bubbles, 3, 960, 544);
  const auto height_at = [&](double t_s) {
    Canvas canvas = flat(960, 544, 200);
    one.draw(t_s, canvas);
    double sum = 0, count = 0;
    for (int y = 0; y < 544; ++y)
      for (int x = 0; x < 960; ++x)
        if (canvas.row(y)[x] != 200) sum += y, count += 1;
    return count > 0 ? sum / count : -1.0;
  };
  int rises = 0, falls = 0;
  for (int i = 0; i < 60; ++i) {
    const double before = height_at(0.1 * i), after = height_at(0.1 * i + 0.1);
    if (before < 0 || after < 0) continue;
    rises += after < before - 3;
    falls += after > before;
  }
  EXPECT_GT(rises, 30);
  EXPECT_LE(falls, 2);  // when it starts again at the bottom
}

TEST(TankWater, TheWallMirrorsTheTankButNotOverAFish) {
  TankScene scene = *find_tank_scene("surface");
  const WallMirror wall(scene, 960);
  const int depth = static_cast<int>(scene.wall_depth * 960);
  Canvas canvas = flat(960, 544);
  for (int x = 400; x < 500; ++x) canvas.row(depth + 20)[x] = 3200;  // something bright before the wall
  std::vector<uint8_t> fish(canvas.light.size());
  fish[static_cast<std::size_t>(depth - 20) * canvas.stride + 450] = 255;
  wall.apply(fish, canvas);
  EXPECT_GT(canvas.row(depth - 20)[420], canvas.row(depth - 20)[300] + 400);
  EXPECT_EQ(canvas.row(depth - 20)[450], 1600);
  EXPECT_LT(canvas.row(depth - 20)[300], 1500);
  EXPECT_EQ(canvas.row(depth + 1)[300], 1600);
  EXPECT_LT(canvas.row(544 - depth)[300], 1500);
  EXPECT_EQ(canvas.row(544 - depth - 2)[300], 1600);
}

TEST(TankWater, LampsStepDriftAndFlickerAtTheMainsAlias) {
  const TankScene& scene = *find_tank_scene("lamp");
  const Lamps lamps(scene);
  EXPECT_FALSE(lamps.steady());
  EXPECT_NEAR(lamps.at(5.9, 0) / lamps.at(6.1, 0), scene.light_before_lamp, 0.05f);
  // 100 Hz seen 30 times a second repeats every third frame, and differs between them and between rows.
  const auto frame = [](int n) { return 10.0 + n / 30.0; };
  EXPECT_NEAR(lamps.at(frame(0), 0.3f), lamps.at(frame(3), 0.3f), 0.3f * scene.flicker);
  EXPECT_GT(std::fabs(lamps.at(frame(0), 0.3f) - lamps.at(frame(1), 0.3f)), 0.5f * scene.flicker);
  EXPECT_GT(std::fabs(lamps.at(frame(0), 0.0f) - lamps.at(frame(0), 0.15f)), 0.5f * scene.flicker);
  float least = 9, most = 0;
  for (int n = 0; n < 900; ++n) {
    least = std::fmin(least, lamps.at(frame(n), 0));
    most = std::fmax(most, lamps.at(frame(n), 0));
  }
  EXPECT_GT(most - least, scene.light_drift);
  EXPECT_LT(most, (1 + scene.light_drift) * (1 + scene.flicker) + 1e-4f);
  Canvas canvas = flat(320, 180);
  lamps.apply(2.0, canvas);
  EXPECT_NEAR(mean_of(canvas) / 1600, scene.light_before_lamp, 0.06);
}

}  // namespace
}  // namespace nt::tank
