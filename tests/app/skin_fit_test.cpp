// SPDX-License-Identifier: Apache-2.0
#include "app/export/skin_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace nt {
namespace {

// A bar of 12 units whose second half folds about its middle.
struct Bar {
  std::vector<RigJoint> joints{{"root", -1, -1, {0, 0}}, {"middle", 0, 2, {6, 0}}, {"end", 1, -1, {12, 0}}};
  std::vector<Vec2> vertices;
  Bar() {
    for (int x = 0; x <= 12; ++x)
      for (int y = -1; y <= 1; ++y) vertices.push_back({static_cast<float>(x), static_cast<float>(y)});
  }
  std::vector<JointPose> pose(float fold) const {
    return {{{0, 0}, 0}, {{6, 0}, fold}, {{6 + 6 * std::cos(fold), 6 * std::sin(fold)}, fold}};
  }
};

SkinSample moved_by(const Bar& bar, const std::vector<SkinVertex>& skin, float fold) {
  SkinSample sample{bar.pose(fold), {}};
  for (std::size_t v = 0; v < bar.vertices.size(); ++v)
    sample.vertices.push_back(skinned(skin[v], bar.vertices[v], bar.joints, sample.joints));
  return sample;
}

TEST(SkinFit, FindsWeightsThatExplainTheMotion) {
  const Bar bar;
  std::vector<SkinVertex> truth(bar.vertices.size());
  for (std::size_t v = 0; v < truth.size(); ++v) {
    const float share = std::min(1.0f, std::max(0.0f, bar.vertices[v].x / 4 - 1));
    truth[v].joints = {0, 1}, truth[v].weights = {1 - share, share};
  }
  std::vector<SkinSample> samples;
  for (const float fold : {-0.9f, -0.4f, 0.3f, 0.8f}) samples.push_back(moved_by(bar, truth, fold));
  const std::vector<SkinVertex> skin = fit_skin(bar.vertices, bar.joints, samples, 12);
  for (std::size_t v = 0; v < skin.size(); ++v) {
    float sum = 0;
    for (std::size_t k = 0; k < kInfluences; ++k) {
      sum += skin[v].weights[k];
      EXPECT_GE(skin[v].weights[k], 0);
      if (skin[v].weights[k] == 0) {
        EXPECT_EQ(skin[v].joints[k], 0);
        continue;
      }
      for (std::size_t m = 0; m < k; ++m) EXPECT_NE(skin[v].joints[k], skin[v].joints[m]);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    const SkinSample other = moved_by(bar, truth, 0.6f);
    EXPECT_LT(length(skinned(skin[v], bar.vertices[v], bar.joints, other.joints) - other.vertices[v]), 0.05f) << v;
  }
}

TEST(SkinFit, AVertexTakesItsNeighboursWeightsWhereTheyExplainItsWorstBetter) {
  const Bar bar;
  std::vector<SkinVertex> skin(bar.vertices.size());
  for (std::size_t v = 0; v < skin.size(); ++v)
    skin[v].joints = {static_cast<uint16_t>(bar.vertices[v].x > 6 ? 1 : 0)}, skin[v].weights = {1};
  const std::vector<SkinVertex> right = skin;
  const std::vector<SkinSample> samples{moved_by(bar, right, 0.1f), moved_by(bar, right, 0.9f)};
  constexpr std::size_t kOdd = 31;  // at x = 10
  skin[kOdd].joints = {0};
  const std::vector<uint32_t> triangles{30, 31, 33, 33, 31, 34, 0, 1, 3};
  share_with_neighbours(skin, triangles, bar.vertices, bar.joints, samples);
  for (std::size_t v = 0; v < skin.size(); ++v) EXPECT_EQ(skin[v].joints[0], right[v].joints[0]) << v;
}

TEST(SkinFit, TurnsAJointToWhereItsVerticesWent) {
  const Bar bar;
  std::vector<SkinVertex> skin(bar.vertices.size());
  for (std::size_t v = 0; v < skin.size(); ++v)
    skin[v].joints = {static_cast<uint16_t>(bar.vertices[v].x > 6 ? 1 : 0)}, skin[v].weights = {1};
  const SkinSample wanted = moved_by(bar, skin, 0.7f);
  std::vector<JointPose> pose = wanted.joints;
  pose[1].turn_rad = 0.2f;
  fit_turns(skin, bar.vertices, wanted.vertices, bar.joints, 12, pose);
  EXPECT_NEAR(pose[1].turn_rad, 0.7f, 0.01f);
  EXPECT_EQ(pose[0].turn_rad, 0);
  EXPECT_FLOAT_EQ(pose[2].turn_rad, 0.7f);  // carries nothing: keeps its bone's
}

}  // namespace
}  // namespace nt
