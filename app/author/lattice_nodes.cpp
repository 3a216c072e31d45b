// SPDX-License-Identifier: Apache-2.0
#include "app/author/lattice_nodes.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace nt {
namespace {

constexpr float kReach = 0.8f;  // of a node from the solid, in spacings: the circumradius of a cell is 0.56
constexpr float kJiggle = 0.04f;
constexpr float kKeepAway = 0.35f;  // of grid nodes from skeleton samples
constexpr int kMostHalvings = 4;

std::vector<Vec3> grid_nodes(const SolidGrid& grid, float h, uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> out;
  const Vec3 low = grid.centre(0, 0, 0), high = grid.centre(grid.size(0) - 1, grid.size(1) - 1, grid.size(2) - 1);
  const auto count = [&](float a, float b) { return static_cast<int>((b - a) / h) + 2; };
  for (int z = 0; z < count(low.z, high.z); ++z) {
    for (int y = 0; y < count(low.y, high.y); ++y) {
      for (int x = 0; x < count(low.x, high.x); ++x) {
        for (int body = 0; body < 2; ++body) {
          const float half = body == 0 ? 0.0f : 0.5f;
          const Vec3 jiggle{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f};
          const Vec3 p = low + h * (Vec3{static_cast<float>(x) + half, static_cast<float>(y) + half,
                                         static_cast<float>(z) + half} +
                                    2.0f * kJiggle * jiggle);
          if (grid.distance(p) <= kReach * h) out.push_back(p);
        }
      }
    }
  }
  return out;
}

// The bones cut into edges of about `step`, each twice as fine where another bone's point lies in an edge's ball.
class SampledSkeleton {
 public:
  SampledSkeleton(const SkeletonSpec& spec, float step) : spec_(spec) {
    parts_.assign(spec.joints.size(), 0);
    for (std::size_t j = 0; j < spec.joints.size(); ++j) {
      if (spec.joints[j].parent < 0) continue;
      parts_[j] = std::max(1, static_cast<int>(std::lround(bone_length(j) / step)));
    }
    for (int round = 0; round <= kMostHalvings; ++round) {
      sample();
      if (!refine()) break;
    }
  }
  std::vector<Vec3> points;
  std::vector<std::vector<uint16_t>> bones;

 private:
  float bone_length(std::size_t j) const {
    return length(spec_.joints[j].position - spec_.joints[static_cast<std::size_t>(spec_.joints[j].parent)].position);
  }
  void sample() {
    points.clear();
    bones.assign(spec_.joints.size(), {});
    for (const auto& joint : spec_.joints) points.push_back(joint.position);
    for (std::size_t j = 0; j < spec_.joints.size(); ++j) {
      const auto own = static_cast<uint16_t>(j);
      if (spec_.joints[j].parent < 0) {
        bones[j] = {own};
        continue;
      }
      const auto parent = static_cast<uint16_t>(spec_.joints[j].parent);
      bones[j].push_back(parent);
      for (int k = 1; k < parts_[j]; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(parts_[j]);
        bones[j].push_back(static_cast<uint16_t>(points.size()));
        points.push_back(points[parent] + t * (points[own] - points[parent]));
      }
      bones[j].push_back(own);
    }
  }
  bool refine() {
    bool any = false;
    for (std::size_t j = 0; j < bones.size(); ++j) {
      bool crowded = false;
      for (std::size_t k = 1; k < bones[j].size(); ++k) {
        const Vec3 a = points[bones[j][k - 1]], b = points[bones[j][k]];
        for (std::size_t p = 0; p < points.size(); ++p) {
          if (p != bones[j][k - 1] && p != bones[j][k]) crowded = crowded || dot(points[p] - a, points[p] - b) < 0.0f;
        }
      }
      if (crowded) parts_[j] *= 2, any = true;
    }
    return any;
  }
  const SkeletonSpec& spec_;
  std::vector<int> parts_;
};

bool clear_of_skeleton(Vec3 p, const SampledSkeleton& s, float h) {
  for (const Vec3 q : s.points) {
    if (length(p - q) < kKeepAway * h) return false;
  }
  for (const auto& bone : s.bones) {
    for (std::size_t k = 1; k < bone.size(); ++k) {
      // Inside the ball over the edge, with a margin: the edge ends are seen under more than a right angle.
      const Vec3 a = s.points[bone[k - 1]], b = s.points[bone[k]];
      if (length(p - 0.5f * (a + b)) < 0.53f * length(b - a)) return false;
    }
  }
  return true;
}

}  // namespace

LatticeNodes make_nodes(const SolidGrid& grid, const SkeletonSpec& skeleton, int wanted, uint64_t seed) {
  LatticeNodes out;
  // A body-centred grid has two nodes a cell; the shell around the solid makes the true count larger.
  float low = grid.cell(), high = 40.0f * grid.cell();
  for (int round = 0; round < 14; ++round) {
    const float h = std::sqrt(low * high);
    const SampledSkeleton bones(skeleton, 0.8f * h);
    out = {};
    out.points = bones.points;
    out.fixed = bones.points.size();
    out.bones = bones.bones;
    out.spacing = h;
    for (const Vec3 p : grid_nodes(grid, h, seed)) {
      if (clear_of_skeleton(p, bones, h)) out.points.push_back(p);
    }
    const auto count = static_cast<int>(out.points.size());
    if (std::abs(count - wanted) * 50 < wanted) break;
    (count > wanted ? low : high) = h;
  }
  return out;
}

}  // namespace nt
