// SPDX-License-Identifier: Apache-2.0
// Recorded markers on real meshes: the frames are followed, and gaps make no jump.
#include "app/mocap/marker_puppet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/author/triangle_mesh.h"

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

}  // namespace
}  // namespace nt
