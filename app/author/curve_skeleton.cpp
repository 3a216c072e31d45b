// SPDX-License-Identifier: Apache-2.0
#include "app/author/curve_skeleton.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kCells = 64;  // along the longest side
constexpr int kMostLimbs = 16;
constexpr float kDear = 5000.0f;    // of a step along the surface, in steps along the middle
constexpr float kReach = 1.6f;      // of a path, in its distances from the surface
constexpr float kShortLimb = 2.2f;  // a path shorter than so many distances from the surface where it joins is a bump
constexpr float kStraight = 1.2f;   // cells that a bone may lie beside its path

using Index = uint32_t;
constexpr Index kNone = 0xffffffffu;

// The solid cells, their distance from the surface, and the tree that grows in them.
class Grower {
 public:
  explicit Grower(const SolidGrid& grid) : grid_(grid) {
    for (int a = 0; a < 3; ++a) size_[a] = grid.size(a);
    solid_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    each_cell([&](Index i, int x, int y, int z) { solid_[i] = grid.solid(x, y, z); });
    measure_depth();
  }

  SkeletonSpec grow() {
    root_ = static_cast<Index>(std::max_element(depth_.begin(), depth_.end()) - depth_.begin());
    if (!(depth_[root_] > 0.0f)) throw UserError("the mesh holds no solid to put a skeleton into");
    const float deepest = depth_[root_];
    walk([](Index) { return 1.0f; }, distance_, nullptr);
    walk(
        [&](Index i) {
          const float shallow = 1.0f - depth_[i] / (1.01f * deepest), two = shallow * shallow, four = two * two;
          return 1.0f + kDear * four * four * four * four;
        },
        dear_, &before_);
    joint_of_.assign(solid_.size(), -1);
    done_.assign(solid_.size(), 0);
    out_.joints.push_back({"root", -1, place(root_), {}});
    joint_of_[root_] = 0;
    cover(root_);
    for (int limb = 0; limb < kMostLimbs; ++limb) {
      const Index tip = farthest();
      if (tip == kNone) break;
      add_limb(tip);
    }
    return out_;
  }

 private:
  template <class F>
  void each_cell(F f) {
    Index i = 0;
    for (int z = 0; z < size_[2]; ++z) {
      for (int y = 0; y < size_[1]; ++y) {
        for (int x = 0; x < size_[0]; ++x) f(i++, x, y, z);
      }
    }
  }
  std::array<int, 3> cell(Index i) const {
    const int n = static_cast<int>(i);
    return {n % size_[0], n / size_[0] % size_[1], n / (size_[0] * size_[1])};
  }
  Vec3 place(Index i) const {
    const auto c = cell(i);
    return grid_.centre(c[0], c[1], c[2]);
  }
  // f(neighbour, steps between them) for the 26 around a cell.
  template <class F>
  void around(Index i, F f) const {
    const auto c = cell(i);
    for (int k = 0; k < 27; ++k) {
      const int d[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      const int x = c[0] + d[0], y = c[1] + d[1], z = c[2] + d[2];
      if (k == 13 || x < 0 || y < 0 || z < 0 || x >= size_[0] || y >= size_[1] || z >= size_[2]) continue;
      const float steps = std::sqrt(static_cast<float>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
      f(static_cast<Index>((z * size_[1] + y) * size_[0] + x), steps);
    }
  }
  // Dijkstra from many cells at once over those where `open` holds.
  void spread(std::vector<float>& distance, const std::function<bool(Index)>& open,
              const std::function<float(Index)>& price, std::vector<Index>* before) const {
    using Entry = std::pair<float, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (Index i = 0; i < distance.size(); ++i) {
      if (distance[i] == 0.0f) queue.push({0.0f, i});
    }
    while (!queue.empty()) {
      const auto [far, i] = queue.top();
      queue.pop();
      if (far > distance[i]) continue;
      around(i, [&](Index j, float steps) {
        const float next = far + steps * price(j);
        if (!open(j) || next >= distance[j]) return;
        distance[j] = next;
        if (before != nullptr) (*before)[j] = i;
        queue.push({next, j});
      });
    }
  }
  void measure_depth() {
    depth_.assign(solid_.size(), std::numeric_limits<float>::infinity());
    for (Index i = 0; i < depth_.size(); ++i) {
      if (!solid_[i]) depth_[i] = 0.0f;
    }
    spread(
        depth_, [&](Index j) { return solid_[j] != 0; }, [](Index) { return 1.0f; }, nullptr);
  }
  void walk(const std::function<float(Index)>& price, std::vector<float>& distance, std::vector<Index>* before) {
    distance.assign(solid_.size(), std::numeric_limits<float>::infinity());
    distance[root_] = 0.0f;
    if (before != nullptr) before->assign(solid_.size(), kNone);
    spread(
        distance, [&](Index j) { return solid_[j] != 0; }, price, before);
  }
  Index farthest() const {
    Index best = kNone;
    for (Index i = 0; i < distance_.size(); ++i) {
      if (done_[i] || !std::isfinite(distance_[i])) continue;
      if (best == kNone || distance_[i] > distance_[best]) best = i;
    }
    return best;
  }
  // What lies within a path cell's own thickness belongs to it.
  void cover(Index i) {
    const auto c = cell(i);
    const float reach = kReach * depth_[i] + 1.5f;
    const int r = static_cast<int>(reach);
    for (int z = std::max(0, c[2] - r); z <= std::min(size_[2] - 1, c[2] + r); ++z) {
      for (int y = std::max(0, c[1] - r); y <= std::min(size_[1] - 1, c[1] + r); ++y) {
        for (int x = std::max(0, c[0] - r); x <= std::min(size_[0] - 1, c[0] + r); ++x) {
          const auto square =
              static_cast<float>((x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]) + (z - c[2]) * (z - c[2]));
          if (square <= reach * reach) done_[static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x)] = 1;
        }
      }
    }
  }

  void add_limb(Index tip) {
    std::vector<Index> path{tip};
    while (joint_of_[path.back()] < 0 && before_[path.back()] != kNone) path.push_back(before_[path.back()]);
    std::reverse(path.begin(), path.end());
    for (const Index i : path) cover(i);
    done_[tip] = 1;
    if (static_cast<float>(path.size()) < kShortLimb * depth_[path.front()] + 3.0f) return;
    std::vector<Vec3> curve;
    for (const Index i : path) curve.push_back(place(i));
    smooth(curve);
    std::vector<std::size_t> corners{0};
    straighten(curve, 0, curve.size() - 1, corners);
    int parent = joint_of_[path.front()];
    std::size_t corner = 1;
    for (std::size_t k = 1; k < path.size(); ++k) {
      // A later limb that meets this bone hangs on the joint nearest to there.
      const bool nearer_end = 2 * k > corners[corner - 1] + corners[corner];
      joint_of_[path[k]] = nearer_end ? static_cast<int>(out_.joints.size()) : parent;
      if (k != corners[corner]) continue;
      out_.joints.push_back({"joint_" + std::to_string(out_.joints.size()), parent, curve[k], {}});
      parent = static_cast<int>(out_.joints.size()) - 1;
      if (++corner == corners.size()) break;
    }
  }
  static void smooth(std::vector<Vec3>& curve) {
    for (int round = 0; round < 6; ++round) {
      std::vector<Vec3> next = curve;
      for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
        next[k] = 0.25f * curve[k - 1] + 0.5f * curve[k] + 0.25f * curve[k + 1];
      }
      curve = next;
    }
  }
  // Appends the corners after `from`, up to and with `to`.
  void straighten(const std::vector<Vec3>& curve, std::size_t from, std::size_t to, std::vector<std::size_t>& corners) {
    const Vec3 along = curve[to] - curve[from];
    const float square = std::max(length_sq(along), 1e-20f);
    std::size_t worst = from;
    float most = kStraight * grid_.cell();
    for (std::size_t k = from + 3; k + 3 < to; ++k) {
      const Vec3 p = curve[k] - curve[from];
      const float off = length(p - along * std::clamp(dot(p, along) / square, 0.0f, 1.0f));
      if (off > most) most = off, worst = k;
    }
    if (worst != from) {
      straighten(curve, from, worst, corners);
      straighten(curve, worst, to, corners);
    } else {
      corners.push_back(to);
    }
  }

  const SolidGrid& grid_;
  int size_[3] = {};
  std::vector<uint8_t> solid_, done_;
  std::vector<float> depth_, distance_, dear_;  // in cells
  std::vector<Index> before_;
  std::vector<int> joint_of_;  // of cells on a path
  Index root_ = 0;
  SkeletonSpec out_;
};

}  // namespace

SkeletonSpec curve_skeleton(const TriangleMesh& source) {
  const TriangleMesh mesh = cleaned(source);
  if (mesh.triangles.empty()) throw UserError("the mesh has no triangle that could be used");
  return Grower(SolidGrid(mesh, kCells, 2)).grow();
}

}  // namespace nt
