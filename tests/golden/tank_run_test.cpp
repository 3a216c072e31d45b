// SPDX-License-Identifier: Apache-2.0
// The same bits on every target and in every build: 300 frames of the tank, each stage folded into one hash.
// A change of method changes these values: then look at bench_accuracy first, and pin the new ones here.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "core/base/hash.h"
#include "tests/support/tank_run.h"

namespace {

struct Golden {
  const char* scene;
  nt::BackgroundKind background;
  int frames;
  int width, height;
  const char *tank_frames, *integer_stages, *poses, *vertices;
};

constexpr Golden kGolden[] = {
    {"calm", nt::BackgroundKind::vibe, 300, 960, 544, "cc2e7b030ce71d83", "f26fa4a16acb3103", "71a465a27bd2b68e",
     "501492d54c0c33c1"},
    {"calm", nt::BackgroundKind::vibe, 10000, 320, 180, "6430d7fd48b2bb7d", "a5e5df789a03b76d", "54d12bbf1684af3c",
     "8182266541713f27"},
    {"shadow", nt::BackgroundKind::vibe, 120, 960, 544, "b4391060a1d89061", "82ca4a31949a75f5", "35d5635dbdf23e8f",
     "faf797e364851a48"},
    {"night", nt::BackgroundKind::vibe, 120, 960, 544, "31753c3abef4667d", "15f5c18139272f45", "ceb5430d8a9dce55",
     "60a42197388a3704"},
    {"calm", nt::BackgroundKind::still, 120, 960, 544, "4b5cb26b8a3874dc", "4e330cc078839fb6", "7fd9667d39eec822",
     "cad0b5f7d37f9378"},
    {"calm", nt::BackgroundKind::backlit, 120, 960, 544, "4b5cb26b8a3874dc", "6bb0c536ef08b9b5", "83fe39899187d078",
     "e3f08b27917289ba"},
};

uint64_t hash_float(float v, uint64_t seed) {
  uint32_t bits;
  std::memcpy(&bits, &v, sizeof bits);
  return nt::hash_u64(bits, seed);
}

uint64_t hash_points(std::span<const nt::Vec2> points, uint64_t seed) {
  for (const nt::Vec2 p : points) seed = hash_float(p.y, hash_float(p.x, seed));
  return seed;
}

uint64_t hash_pose(const nt::FishPose& pose, uint64_t seed) {
  seed = nt::hash_u64(static_cast<uint64_t>(pose.status), seed);
  if (!pose.ok()) return seed;
  const nt::Vec2 points[] = {pose.centre, pose.dir,    pose.head,   pose.tail,  pose.jun_tl,
                             pose.jun_tr, pose.jun_bl, pose.jun_br, pose.l_fin, pose.r_fin};
  seed = hash_points(points, seed);
  seed = hash_points({pose.up_axis, static_cast<std::size_t>(pose.u_num)}, seed);
  seed = hash_points({pose.low_axis, static_cast<std::size_t>(pose.l_num)}, seed);
  return hash_float(pose.axis_len, seed);
}

std::string hex(uint64_t v) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(v));
  return text;
}

class TankRunGolden : public testing::TestWithParam<Golden> {};

}  // namespace

TEST_P(TankRunGolden, SameBits) {
  const Golden& golden = GetParam();
  nt::CaptureSettings settings;
  settings.background.kind = golden.background;
  settings.fingerprint = true;
  const nt::TankSettings tank{.scene = golden.scene, .seed = 1, .width = golden.width, .height = golden.height};
  nt::test::TankRun run(tank, nt::test::limits_for(tank), settings);
  uint64_t frames = nt::kHashSeed, integers = nt::kHashSeed, poses = nt::kHashSeed, vertices = nt::kHashSeed;
  for (int n = 0; n < golden.frames; ++n) {
    run.film();
    run.step();
    const nt::LumaView luma = run.frame().luma;
    for (int y = 0; y < luma.height; ++y)
      frames = nt::hash_bytes(luma.row(y), static_cast<std::size_t>(luma.width), frames);
    integers = nt::hash_u64(run.capture().integer_hash(), integers);
    poses = hash_pose(run.capture().pose(), poses);
    if (run.capture().pose().ok()) vertices = hash_points(run.retarget().vertices(), vertices);
  }
  EXPECT_EQ(hex(frames), golden.tank_frames);
  EXPECT_EQ(hex(integers), golden.integer_stages);
  EXPECT_EQ(hex(poses), golden.poses);
  EXPECT_EQ(hex(vertices), golden.vertices);
}

INSTANTIATE_TEST_SUITE_P(Golden, TankRunGolden, testing::ValuesIn(kGolden), [](const auto& test) {
  return std::string(test.param.scene) + "_" + std::to_string(static_cast<int>(test.param.background)) + "_" +
         std::to_string(test.param.frames);
});
