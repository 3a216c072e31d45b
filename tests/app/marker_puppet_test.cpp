// SPDX-License-Identifier: Apache-2.0
// Recorded markers on real meshes: the frames are followed, and gaps make no jump.
#include "app/mocap/marker_puppet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/author/character_lattice.h"
#include "app/author/curve_skeleton.h"
#include "app/author/marker_places.h"
#include "app/author/triangle_mesh.h"
#include "app/mocap/marker_choice.h"

namespace nt {
namespace {

const std::filesystem::path kShared = NEONTETRA_SHARED_DATA;

TEST(MarkerPuppetTest, ABodyFollows36MarkersAndSurvivesTheirGap) {
  if (!std::filesystem::exists(kShared / "mocap")) GTEST_SKIP() << "no shared data";
  const MarkerFile file = read_marker_file(kShared / "mocap/fullbody36_optitrack.c3d");
  const TriangleMesh mesh = read_triangles(kShared / "meshes/human_man.obj");
  std::vector<std::size_t> all(file.markers());
  for (std::size_t m = 0; m < all.size(); ++m) all[m] = m;
  PuppetOptions options;
  options.lattice.vertices = 430;
  options.turns = {parse_axes("x,z,-y")};
  MarkerPuppet puppet(mesh, {}, file, all, 0, options);
  EXPECT_LT(puppet.registration().rms, 0.06f);  // metres
  std::vector<float> last;
  float largest = 0.0f, error = 0.0f;
  int held = 0;
  for (std::size_t f = 0; f < file.frames(); f += f < 1100 ? 5 : 1) {
    held += puppet.step(file.frame(f)).held;
    EXPECT_EQ(puppet.lattice().quality().inverted, 0) << f;
    for (std::size_t i = 0; i < last.size() && f > 1100; i += 3) {
      const auto& p = puppet.places();
      largest = std::max(largest, length(Vec3{p[i] - last[i], p[i + 1] - last[i + 1], p[i + 2] - last[i + 2]}));
    }
    last = puppet.places();
    error = std::max(error, f < 1000 ? puppet.marker_error() : 0.0f);
  }
  EXPECT_GT(held, 40);
  EXPECT_LT(error, 0.03f);
  EXPECT_LT(largest, 0.12f);
}

// A glove's 13 markers, mirrored, on a left hand: those placed by name stay with their finger, whatever the registration
// leaves over.
TEST(MarkerPuppetTest, AHandFollowsAGloveFingerByFinger) {
  if (!std::filesystem::exists(kShared / "mocap")) GTEST_SKIP() << "no shared data";
  MarkerChoice choice;
  choice.only = "hand,thumb,little,ring,middle,index", choice.mirror = true;
  const MarkerFile file = read_recording(kShared / "mocap/hand21_qualisys_a.tsv", choice);
  const TriangleMesh mesh = read_triangles(kShared / "meshes/hand_closed.obj");
  std::vector<Vec2> flat;
  std::vector<float> heights;
  for (const Vec3 p : mesh.positions) flat.push_back({p.x, p.y}), heights.push_back(p.z);
  Character character;
  character.vertices = flat, character.heights = heights, character.triangles = mesh.triangles;
  const auto places = read_marker_places(NEONTETRA_ASSETS "/skeletons/hand_left.markers", mesh);
  const LatticeAsset asset(character, curve_skeleton(mesh), places, LatticeDrive::markers, {368, LatticeForm::arap});
  character.lattice = asset.view();
  const auto used = chosen_markers(file, choice);
  ASSERT_EQ(used.size(), 13u);
  MarkerPuppet puppet(character, file, used, 0, {});
  EXPECT_TRUE(puppet.bound_by_name());
  std::vector<float> last;
  for (std::size_t f = 0; f < file.frames(); f += 2) {
    puppet.step(file.frame(f));
    const LatticeQuality q = puppet.lattice().quality();
    EXPECT_EQ(q.inverted, 0) << f;
    EXPECT_LT(q.bone_error_max, 1e-3f) << f;
    float largest = 0.0f;
    for (std::size_t i = 0; i < last.size(); i += 3) {
      const auto& p = puppet.places();
      largest = std::max(largest, length(Vec3{p[i] - last[i], p[i + 1] - last[i + 1], p[i + 2] - last[i + 2]}));
    }
    EXPECT_LT(largest, 0.07f * puppet.diagonal()) << f;
    last = puppet.places();
  }
  EXPECT_LT(puppet.marker_error(), 0.02f * puppet.diagonal());
}

}  // namespace
}  // namespace nt
