// SPDX-License-Identifier: Apache-2.0
#include "app/export/skin_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

// The squared distance between a joint and a vertex, in body lengths, counts this much against the mean squared error.
constexpr double kNearness = 1e-6;
// How much a joint keeps to its bone, in squared body lengths a vertex: one that carries little would turn at random.
constexpr double kBoneStiffness = 2e-4;
constexpr int kMostSteps = 400;
constexpr double kDone = 1e-12;  // of the cost, in squared body lengths

Vec2 moved(const RigJoint& joint, const JointPose& pose, Vec2 rest) {
  const float c = std::cos(pose.turn_rad), s = std::sin(pose.turn_rad);
  const Vec2 p = rest - joint.rest;
  return pose.at + Vec2{p.x * c - p.y * s, p.x * s + p.y * c};
}

// Minimises w' G w over w >= 0, sum w = 1, from the w given: moves weight from the worst joint that has some to the best.
void minimise(const Eigen::MatrixXd& g, Eigen::VectorXd& w) {
  Eigen::VectorXd slope = g * w;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Index worst = -1, best = 0;
    for (Eigen::Index j = 0; j < w.size(); ++j) {
      if (w[j] > 0 && (worst < 0 || slope[j] > slope[worst])) worst = j;
      if (slope[j] < slope[best]) best = j;
    }
    const double gain = slope[worst] - slope[best];
    if (gain <= kDone) return;
    const double curve = g(worst, worst) + g(best, best) - 2 * g(worst, best);
    const double share = curve > 0 ? std::min(gain / curve, w[worst]) : w[worst];
    w[worst] = share >= w[worst] ? 0 : w[worst] - share;
    w[best] += share;
    slope += share * (g.col(best) - g.col(worst));
  }
}

SkinVertex strongest(const Eigen::MatrixXd& g, const Eigen::VectorXd& w) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(w.size()));
  std::iota(order.begin(), order.end(), 0);
  const std::size_t kept = std::min(kInfluences, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    [&](Eigen::Index a, Eigen::Index b) { return w[a] > w[b] || (w[a] == w[b] && a < b); });
  order.resize(kept);
  const auto count = static_cast<Eigen::Index>(kept);
  Eigen::MatrixXd few(count, count);
  Eigen::VectorXd weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    weights[i] = w[order[static_cast<std::size_t>(i)]];
    for (Eigen::Index k = 0; k < count; ++k)
      few(i, k) = g(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(k)]);
  }
  weights /= weights.sum();
  minimise(few, weights);
  constexpr double kNothing = 1e-4;
  SkinVertex skin;
  double sum = 0;
  for (Eigen::Index i = 0; i < count; ++i) sum += weights[i] >= kNothing ? weights[i] : 0;
  std::size_t at = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (weights[i] < kNothing) continue;
    skin.joints[at] = static_cast<uint16_t>(order[static_cast<std::size_t>(i)]);
    skin.weights[at++] = static_cast<float>(weights[i] / sum);
  }
  return skin;
}

// How much each sample counts for a vertex: more where the last fit is farther off than it is as a rule, so that the
// greatest errors shrink (iteratively reweighted least squares; the fourth power of the error in place of the second).
void weigh_worst(const SkinVertex& before, Vec2 rest, std::span<const RigJoint> joints,
                 std::span<const SkinSample> samples, std::size_t v, std::span<float> counts) {
  float sum = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    counts[s] = length_sq(skinned(before, rest, joints, samples[s].joints) - samples[s].vertices[v]);
    sum += counts[s];
  }
  const float mean = sum / static_cast<float>(samples.size());
  for (float& c : counts) c = mean > 0 ? std::sqrt(1.0f + c / mean) : 1.0f;
}

float worst_sq(const SkinVertex& skin, Vec2 rest, std::span<const RigJoint> joints, std::span<const SkinSample> samples,
               std::size_t v) {
  float worst = 0;
  for (const SkinSample& sample : samples)
    worst = std::max(worst, length_sq(skinned(skin, rest, joints, sample.joints) - sample.vertices[v]));
  return worst;
}

}  // namespace

void share_with_neighbours(std::span<SkinVertex> skin, std::span<const uint32_t> triangles,
                           std::span<const Vec2> vertices, std::span<const RigJoint> joints,
                           std::span<const SkinSample> samples) {
  const std::vector<SkinVertex> fitted(skin.begin(), skin.end());
  std::vector<float> worst(skin.size());
  for (std::size_t v = 0; v < skin.size(); ++v) worst[v] = worst_sq(fitted[v], vertices[v], joints, samples, v);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t v = triangles[i], neighbour = triangles[i - i % 3 + (i + 1) % 3];
    for (const auto& [to, from] : {std::pair{v, neighbour}, std::pair{neighbour, v}}) {
      const float other = worst_sq(fitted[from], vertices[to], joints, samples, to);
      if (other < worst[to]) worst[to] = other, skin[to] = fitted[from];
    }
  }
}

std::vector<SkinVertex> fit_skin(std::span<const Vec2> vertices, std::span<const RigJoint> joints,
                                 std::span<const SkinSample> samples, float length,
                                 std::span<const SkinVertex> before) {
  const auto count = static_cast<Eigen::Index>(joints.size());
  const auto rows = static_cast<Eigen::Index>(2 * samples.size());
  std::vector<SkinVertex> skin(vertices.size());
  Eigen::MatrixXf apart(rows, count);
  std::vector<float> counts(samples.size(), 1.0f);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!before.empty()) weigh_worst(before[v], vertices[v], joints, samples, v, counts);
    Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto joint = static_cast<std::size_t>(j);
      for (std::size_t s = 0; s < samples.size(); ++s) {
        const Vec2 a = (moved(joints[joint], samples[s].joints[joint], vertices[v]) - samples[s].vertices[v]) *
                       (counts[s] / length);
        apart(static_cast<Eigen::Index>(2 * s), j) = a.x;
        apart(static_cast<Eigen::Index>(2 * s + 1), j) = a.y;
      }
    }
    cost = (apart.transpose() * apart).cast<double>() / static_cast<double>(samples.size());
    Eigen::Index nearest = 0;
    for (Eigen::Index j = 0; j < count; ++j) {
      const double off = length_sq(vertices[v] - joints[static_cast<std::size_t>(j)].rest) / (length * length);
      cost(j, j) += kNearness * off;
      if (cost(j, j) < cost(nearest, nearest)) nearest = j;
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
    weights[nearest] = 1;
    minimise(cost, weights);
    skin[v] = strongest(cost, weights);
  }
  return skin;
}

void fit_turns(std::span<const SkinVertex> skin, std::span<const Vec2> vertices, std::span<const Vec2> wanted,
               std::span<const RigJoint> joints, float length, std::span<JointPose> pose) {
  struct Hold {
    std::size_t vertex;
    float weight;
  };
  std::vector<std::vector<Hold>> holds(joints.size());
  std::vector<Vec2> missing(vertices.size());  // wanted - skinned
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    missing[v] = wanted[v] - skinned(skin[v], vertices[v], joints, pose);
    for (std::size_t k = 0; k < kInfluences; ++k)
      if (skin[v].weights[k] > 0) holds[skin[v].joints[k]].push_back({v, skin[v].weights[k]});
  }
  std::vector<double> bones;
  for (const JointPose& joint : pose) bones.push_back(static_cast<double>(joint.turn_rad));
  const double size = static_cast<double>(length) * static_cast<double>(length);
  const double pull = kBoneStiffness * size * static_cast<double>(vertices.size()) / static_cast<double>(joints.size());
  for (int round = 0; round < kTurnRounds; ++round) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].parent < 0) continue;
      const JointPose before = pose[j];
      double cosine = pull * std::cos(bones[j]), sine = pull * std::sin(bones[j]);
      for (const Hold hold : holds[j]) {
        const Vec2 arm = vertices[hold.vertex] - joints[j].rest;
        const Vec2 to =
            (moved(joints[j], before, vertices[hold.vertex]) - before.at) * hold.weight + missing[hold.vertex];
        cosine += static_cast<double>(hold.weight * dot(arm, to));
        sine += static_cast<double>(hold.weight * cross(arm, to));
      }
      if (cosine * cosine + sine * sine <= 0) continue;
      pose[j].turn_rad = det::unwrap(static_cast<float>(std::atan2(sine, cosine)), before.turn_rad);
      for (const Hold hold : holds[j]) {
        const Vec2 rest = vertices[hold.vertex];
        missing[hold.vertex] += (moved(joints[j], before, rest) - moved(joints[j], pose[j], rest)) * hold.weight;
      }
    }
  }
}

Vec2 skinned(const SkinVertex& skin, Vec2 rest, std::span<const RigJoint> joints, std::span<const JointPose> pose) {
  Vec2 sum;
  for (std::size_t k = 0; k < kInfluences; ++k) {
    if (skin.weights[k] > 0) sum += moved(joints[skin.joints[k]], pose[skin.joints[k]], rest) * skin.weights[k];
  }
  return sum;
}

}  // namespace nt
