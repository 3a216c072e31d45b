// SPDX-License-Identifier: Apache-2.0
#include "app/export/glb.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/export/png.h"
#include "app/export/pose_csv.h"
#include "app/export/skinned_model.h"
#include "app/progress.h"
#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr int kFitRounds = 12;

// The scene is the working frame itself.
const Pane kFramePane{{-0.5f, -0.5f}, 1, 0, 0};

// How often each error was measured, in steps of 0.001 % of the body's length.
class ErrorCount {
 public:
  void add(double percent) {
    most_ = std::max(most_, percent);
    ++count_[std::min(static_cast<std::size_t>(percent / kStep), count_.size() - 1)];
    ++total_;
  }
  double quantile(double share) const {
    const auto wanted = static_cast<int64_t>(share * static_cast<double>(total_));
    int64_t passed = 0;
    for (std::size_t i = 0; i + 1 < count_.size(); ++i) {
      passed += count_[i];
      if (passed > wanted) return std::min((static_cast<double>(i) + 1) * kStep, most_);
    }
    return most_;
  }
  double most() const { return most_; }

 private:
  static constexpr double kStep = 0.001;
  std::vector<int64_t> count_ = std::vector<int64_t>(100'000);
  int64_t total_ = 0;
  double most_ = 0;
};

class Maker {
 public:
  Maker(const Wardrobe& wardrobe, const Performance& performance, const GlbOptions& options)
      : wardrobe_(wardrobe),
        performance_(performance),
        options_(options),
        character_(wardrobe.character(0)),
        rig_(character_),
        body_len_(bone_lengths(character_).body_len),
        unit_(options.length / static_cast<double>(body_len_)),
        progress_(static_cast<int64_t>(2 * performance.frames.size())) {
    samples_ = ordinary_poses();
  }

  GlbReport write(const std::string& path) {
    start();
    sample_frames();
    fit();
    keys();
    write_model(path, model_);
    const bool lattice = Actor(wardrobe_, 0).retarget().lattice() != nullptr;
    return {model_.vertices.size(),      model_.joints.size(),  model_.times_s.size(),  model_.note,
            lattice ? "lattice" : "mls", errors_.quantile(0.5), errors_.quantile(0.99), errors_.most()};
  }

 private:
  // Character axes -> the file's.
  Vec3 axes(Vec2 p, float z) const { return character_.solid() ? Vec3{p.x, z, -p.y} : Vec3{p.x, p.y, z}; }
  Vec3 to_file(Vec2 p, float z) const { return axes(p, z) * static_cast<float>(unit_); }

  std::string words() const {
    char length[40];
    std::snprintf(length, sizeof length, "%g", options_.length);
    const std::string plane = character_.solid() ? "Y up, the fish swims in the X-Z plane (X the picture's x, Z its y)"
                                                 : "the plane z = 0, X the picture's x, Y upwards, seen from +Z";
    return plane + "; the fish is " + length + (options_.length == 1 ? " unit" : " units") +
           " long from head to tail; the origin is the first pixel of the source";
  }

  void start() {
    model_.name = std::filesystem::path(wardrobe_.path(0)).stem().string();
    model_.animation = options_.name;
    model_.note = words();
    model_.drawing = !character_.solid();
    model_.axis = axes({0, 0}, 1);
    for (std::size_t v = 0; v < character_.vertices.size(); ++v) {
      model_.vertices.push_back(to_file(character_.vertices[v], character_.solid() ? character_.heights[v] : 0));
      if (!character_.solid()) continue;
      const Vec3 n = character_.normals[v];
      model_.normals.push_back(normalised(axes({n.x, n.y}, n.z), {0, 1, 0}));
    }
    model_.texcoords.assign(character_.texcoords.begin(), character_.texcoords.end());
    model_.triangles.assign(character_.triangles.begin(), character_.triangles.end());
    model_.png = png_bytes(character_.texture, model_.name);
    for (const RigJoint& joint : rig_.joints())
      model_.joints.push_back({joint.name, joint.parent, to_file(joint.rest, 0), {}, {}, {}});
  }

  void add_key(const RigPose& pose) {
    const float px =
        static_cast<float>(options_.length) / (performance_.frames.front().init_len * options_.source_scale);
    const Vec2 centre = to_source(pose.centre, options_.source_scale);
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      ModelJoint& joint = model_.joints[i];
      const JointPose& own = pose.joints[i];
      if (joint.parent < 0) {
        joint.at.push_back(axes(Vec2{centre.x, -centre.y} * px, 0));
        joint.turn_rad.push_back(pose.heading_rad);
        continue;
      }
      const JointPose& parent = pose.joints[static_cast<std::size_t>(joint.parent)];
      const det::SinCos a = det::sincos(-parent.turn_rad);
      const Vec2 d = own.at - parent.at;
      joint.at.push_back(to_file({d.x * a.cos - d.y * a.sin, d.x * a.sin + d.y * a.cos}, 0));
      joint.turn_rad.push_back(own.turn_rad - parent.turn_rad);
    }
    model_.times_s.push_back(static_cast<float>(static_cast<double>(model_.times_s.size()) / performance_.fps));
  }

  SkinSample sample(const Retarget& posed, const RigPose& pose, float zoom) const {
    SkinSample sample{pose.joints, {}};
    sample.vertices.reserve(posed.vertices().size());
    for (const Vec2 v : posed.vertices()) sample.vertices.push_back(to_local(pose, zoom, v));
    return sample;
  }

  // How far a lattice moves a vertex out of its own height, where joints that turn in the plane leave it; character units.
  float lift(const Retarget& posed, std::size_t v, float zoom) const {
    return character_.solid() ? posed.solid().heights()[v] / zoom - character_.heights[v] : 0;
  }

  // A tail that beats, with the fins at four places between folded and open.
  std::vector<SkinSample> ordinary_poses() const {
    constexpr int kPhases = 6, kFinPlaces = 4;
    constexpr float kBeat_rad = 0.6f, kWave_rad = 4.5f;  // at the tail; from the centre to the tail
    std::vector<SkinSample> samples;
    Actor actor(wardrobe_, 0);
    Rig rig(character_);
    const Motion rest = actor.retarget().rest_motion();
    for (int i = 0; i < kPhases * kFinPlaces; ++i) {
      Motion m = rest;
      const float phase = static_cast<float>(i % kPhases) * 2 * det::kPi / kPhases;
      for (int b = 0; b < m.l_num; ++b) {
        const float along = static_cast<float>(b + 1) / static_cast<float>(m.l_num);
        m.low_axis_angle[b] += kBeat_rad * along * det::sincos(phase - kWave_rad * along).sin;
      }
      m.tail_angle += kBeat_rad * det::sincos(phase - kWave_rad).sin;
      for (int b = 0; b < m.u_num; ++b) m.up_axis_angle[b] += 0.1f * det::sincos(phase).sin;
      m.head_angle += 0.15f * det::sincos(phase).sin;
      const float open = kFishFins.folded + kFishFins.width() * static_cast<float>(i / kPhases) / (kFinPlaces - 1);
      m.r_fin_angle = open - det::kHalfPi, m.l_fin_angle = -det::kHalfPi - open;
      actor.see({true, body_len_, m});
      constexpr float kLongAgo_s = 10;  // the filters take it as it is
      actor.pose(1, kLongAgo_s, kFramePane);
      const float zoom = actor.zoom(kFramePane);
      samples.push_back(sample(actor.retarget(), rig.pose(actor.retarget(), zoom), zoom));
    }
    return samples;
  }

  void sample_frames() {
    Actor actor(wardrobe_, 0);
    const std::size_t each = std::max<std::size_t>(1, performance_.frames.size() / kFitFrames);
    perform(actor, performance_, kFramePane, Before::first_pose, [&](std::size_t i) {
      const float zoom = actor.zoom(kFramePane);
      if (i % each == 0) samples_.push_back(sample(actor.retarget(), rig_.pose(actor.retarget(), zoom), zoom));
      progress_.show(static_cast<int64_t>(i) + 1);
    });
  }

  // Weights and turns in turn: each makes the other one's rest smaller.
  void fit() {
    for (int round = 0;; ++round) {
      model_.skin = fit_skin(character_.vertices, rig_.joints(), samples_, body_len_, model_.skin);
      if (round == kFitRounds) break;
      for (SkinSample& sample : samples_)
        fit_turns(model_.skin, character_.vertices, sample.vertices, rig_.joints(), body_len_, sample.joints);
    }
    share_with_neighbours(model_.skin, character_.triangles, character_.vertices, rig_.joints(), samples_);
    samples_.clear();
  }

  void keys() {
    Actor actor(wardrobe_, 0);
    Rig rig(character_);
    RigPose first, pose;
    perform(actor, performance_, kFramePane, Before::first_pose, [&](std::size_t i) {
      const float zoom = actor.zoom(kFramePane);
      pose = rig.pose(actor.retarget(), zoom);
      const SkinSample ours = sample(actor.retarget(), pose, zoom);
      fit_turns(model_.skin, character_.vertices, ours.vertices, rig_.joints(), body_len_, pose.joints);
      if (i == 0) first = pose;
      add_key(pose);
      for (std::size_t v = 0; v < ours.vertices.size(); ++v) {
        const Vec2 skin = skinned(model_.skin[v], character_.vertices[v], rig_.joints(), pose.joints);
        errors_.add(100 *
                    static_cast<double>(std::hypot(length(skin - ours.vertices[v]), lift(actor.retarget(), v, zoom)) /
                                        body_len_));
      }
      progress_.show(static_cast<int64_t>(performance_.frames.size() + i) + 1);
    });
    if (!performance_.loop) return;
    first.heading_rad =
        det::unwrap(first.heading_rad, pose.heading_rad);  // a whole turn, if the loop made one, is kept
    add_key(first);
  }

  const Wardrobe& wardrobe_;
  const Performance& performance_;
  const GlbOptions& options_;
  const Character& character_;
  Rig rig_;
  float body_len_;
  double unit_;  // of the file, a character unit
  Progress progress_;
  std::vector<SkinSample> samples_;
  SkinnedModel model_;
  ErrorCount errors_;
};

}  // namespace

GlbReport write_glb(const std::string& path, const Wardrobe& wardrobe, const Performance& performance,
                    const GlbOptions& options) {
  return Maker(wardrobe, performance, options).write(path);
}

}  // namespace nt
