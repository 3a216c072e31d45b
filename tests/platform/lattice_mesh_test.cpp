// SPDX-License-Identifier: Apache-2.0
// The vertex shader places what the CPU places, read back by transform feedback and as a picture.
#include "platform/display/lattice_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/actor.h"
#include "platform/camera.h"
#include "platform/display.h"

namespace nt {
namespace {

constexpr int kSize = 320;

std::unique_ptr<Display> open_or_null() {
  try {
    return open_headless_display(kSize, kSize);
  } catch (const UserError&) {
    return nullptr;
  }
}

// A whale in mid-stroke.
Motion stroke(const Retarget& retarget) {
  Motion m = retarget.rest_motion();
  for (int i = 0; i < m.l_num; ++i) m.low_axis_angle[i] += 0.05f * static_cast<float>(i);
  m.tail_angle += 0.8f;
  m.dir_rad = 0.7f;
  m.centre = {100, 90};
  return m;
}

class LatticeMeshTest : public ::testing::Test {
 protected:
  const std::vector<std::string> paths_{NEONTETRA_ASSETS "/characters/whale.glb"};
  const Wardrobe cpu_{paths_, {}, Deformer::lattice}, gpu_{paths_, {}, Deformer::lattice, true};
  Scene scene_;
  static void pose(Actor& actor) {
    Sighting sighting;
    sighting.seen = true, sighting.init_len = 200, sighting.motion = stroke(actor.retarget());
    actor.see(sighting);
    actor.pose(1, 0, pane_for(kSize, kSize));
  }
};

TEST_F(LatticeMeshTest, TheShaderPlacesWhatTheCpuPlaces) {
  const auto display = open_or_null();
  if (display == nullptr) GTEST_SKIP() << "no EGL";
  Actor drawn(cpu_, 0), sent(gpu_, 0);
  pose(drawn), pose(sent);
  ASSERT_TRUE(sent.retarget().renderer_places());
  scene_.clear(kSize, kSize, {0, 0, 0, 1});
  sent.draw(scene_);
  const LatticeSkin skin = *scene_.items().back().skin;
  EXPECT_EQ(LatticeMeshes::bytes_each_frame(skin), 48 * skin.rest.size());
  const Character& c = cpu_.character(0);
  std::vector<float> linear(12 * c.lattice.embedding.blocks());
  embed_linear(c.lattice.embedding, c.lattice.view, drawn.retarget().lattice()->lattice().vertices(), linear);
  display->draw_over(scene_, [&] {
    LatticeMeshes meshes;
    const std::vector<float> phong = meshes.places(skin);
    LatticeSkin straight = skin;
    straight.phong = false;
    const std::vector<float> flat = meshes.places(straight);
    ASSERT_EQ(phong.size(), 3 * c.vertices.size());
    float off_phong = 0, off_linear = 0, apart = 0;
    for (std::size_t v = 0; v < c.vertices.size(); ++v) {
      const Vec3 p = drawn.retarget().lattice()->place(v);
      const float* l = &linear[3 * c.lattice.slots[v]];
      off_phong = std::max(off_phong, length(Vec3{phong[3 * v], phong[3 * v + 1], phong[3 * v + 2]} - p));
      off_linear =
          std::max(off_linear, length(Vec3{flat[3 * v] - l[0], flat[3 * v + 1] - l[1], flat[3 * v + 2] - l[2]}));
      apart = std::max(apart, length(Vec3{l[0], l[1], l[2]} - p));
    }
    // Character units: the whale is 900 long.
    EXPECT_LT(off_phong, 0.01f);
    EXPECT_LT(off_linear, 0.01f);
    EXPECT_GT(apart, 0.3f) << "linear and Phong are the same: the test tells nothing";
  });
}

TEST_F(LatticeMeshTest, ThePictureIsTheSame) {
  const auto display = open_or_null();
  if (display == nullptr) GTEST_SKIP() << "no EGL";
  std::vector<uint8_t> shots[2];
  const Wardrobe* wardrobes[2] = {&cpu_, &gpu_};
  for (int k = 0; k < 2; ++k) {
    Actor actor(*wardrobes[k], 0);
    pose(actor);
    scene_.clear(kSize, kSize, {0, 0, 0, 1});
    actor.draw(scene_);
    const std::vector<Vec2> strip{{5, 5}, {40, 5}};
    scene_.lines(strip, {1, 1, 1, 1}, 4);  // what comes after the skin is drawn as ever
    display->draw(scene_);
    const auto pixels = display->pixels();
    shots[k].assign(pixels.begin(), pixels.end());
  }
  ASSERT_EQ(shots[0].size(), shots[1].size());
  int covered = 0, differ = 0;
  for (std::size_t i = 0; i < shots[0].size(); ++i) {
    covered += shots[0][i] > 8;
    differ += std::abs(int{shots[0][i]} - int{shots[1][i]}) > 24;
  }
  EXPECT_GT(covered, 5000);
  EXPECT_LT(differ, covered / 50);
  EXPECT_GT(shots[1][3 * (5 * kSize + 20)], 200);
}

}  // namespace
}  // namespace nt
