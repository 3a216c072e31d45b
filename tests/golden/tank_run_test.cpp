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

constexpr const char* kTankFrames = "cc2e7b030ce71d83";
constexpr const char* kIntegerStages = "d4af0bcff738c52a";
constexpr const char* kPoses = "98fe0448f337891f";
constexpr const char* kVertices = "11965d902cfd30c1";

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

}  // namespace

TEST(Golden, TankRun) {
  nt::test::TankRun run({.scene = "calm", .seed = 1});
  uint64_t frames = nt::kHashSeed, integers = nt::kHashSeed, poses = nt::kHashSeed, vertices = nt::kHashSeed;
  for (int n = 0; n < 300; ++n) {
    run.film();
    run.step();
    const nt::LumaView luma = run.frame().luma;
    for (int y = 0; y < luma.height; ++y)
      frames = nt::hash_bytes(luma.row(y), static_cast<std::size_t>(luma.width), frames);
    integers = nt::hash_u64(run.capture().integer_hash(), integers);
    poses = hash_pose(run.capture().pose(), poses);
    if (run.capture().pose().ok()) vertices = hash_points(run.retarget().vertices(), vertices);
  }
  EXPECT_EQ(hex(frames), kTankFrames);
  EXPECT_EQ(hex(integers), kIntegerStages);
  EXPECT_EQ(hex(poses), kPoses);
  EXPECT_EQ(hex(vertices), kVertices);
  EXPECT_GT(run.poses(), 200);
}
