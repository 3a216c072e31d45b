// SPDX-License-Identifier: Apache-2.0
#include "app/cast.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr int kMostInSchool = 24;
// A school's shape: how late each follower is after the one before, where it swims, how large it is drawn.
constexpr double kDelay_s = 0.12;
constexpr float kAside_bl = 0.42f, kBack_bl = 0.5f;  // from one row to the next, body lengths
constexpr float kFollowerSize = 0.8f;

std::size_t delay_frames(double fps) { return static_cast<std::size_t>(std::max(1L, std::lround(kDelay_s * fps))); }

}  // namespace

void add_deformer_options(CLI::App& command, std::optional<MlsKind>& mls, std::optional<Deformer>& deformer) {
  const std::map<std::string, MlsKind> kinds = {
      {"rigid", MlsKind::rigid}, {"similarity", MlsKind::similarity}, {"affine", MlsKind::affine}};
  command
      .add_option_function<std::string>(
          "--mls", [&mls, kinds](const std::string& name) { mls = kinds.at(name); },
          "how the drawing gives way between its control points: rigid keeps sizes, similarity lets parts "
          "grow and shrink, affine lets them shear too (default: as the character's file says)")
      ->type_name("rigid|similarity|affine")
      ->check(CLI::IsMember({"rigid", "similarity", "affine"}));
  const std::map<std::string, Deformer> deformers = {{"mls", Deformer::mls}, {"lattice", Deformer::lattice}};
  command
      .add_option_function<std::string>(
          "--deformer", [&deformer, deformers](const std::string& name) { deformer = deformers.at(name); },
          "mls: each vertex follows the control points; lattice: a 3D character keeps its volume and its bones' "
          "lengths "
          "(default: lattice where the file has one)")
      ->type_name("mls|lattice")
      ->check(CLI::IsMember({"mls", "lattice"}));
}

void add_cast_options(CLI::App& command, CastOptions& options, CaptureOptions& capture) {
  command
      .add_option(
          "--character", options.characters,
          "a character file, or a picture with a transparent ground; give it several times for several characters")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  command.add_option("--school", options.school, "so many drawings a fish, one following the other (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, kMostInSchool));
  command.add_option("--max-fish", capture.max_fish, "follow so many fish at a time, a drawing for each (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, kMostFish));
  add_deformer_options(command, options.mls, options.deformer);
}

Cast::Cast(const CastOptions& options, const Session& session)
    : wardrobe_(options.characters, options.mls, options.deformer, options.renderer_places),
      school_(static_cast<std::size_t>(options.school)),
      delay_frames_(delay_frames(session.info().fps)) {
  const auto fish = static_cast<std::size_t>(session.capture().fish_count());
  trails_.assign(fish, Trail(delay_frames_ * (school_ - 1) + 1));
  for (std::size_t i = 0; i < fish * school_; ++i) {
    const std::size_t number = i / school_, place = i % school_;
    actors_.emplace_back(wardrobe_, (number + place) % wardrobe_.size(), place == 0 ? 1.0f : kFollowerSize);
  }
}

// Rows of two behind the leader, the left one first.
Sighting Cast::followed(const Trail& trail, std::size_t place) const {
  Sighting sighting = trail.before(place * delay_frames_);
  if (place == 0 || !sighting.seen) return sighting;
  const auto row = static_cast<float>((place + 1) / 2);
  const float side = place % 2 == 1 ? -1.0f : 1.0f;
  const det::SinCos a = det::sincos(sighting.motion.dir_rad);
  const Vec2 dir{a.cos, a.sin};
  sighting.motion.centre += (right_of(dir) * (side * kAside_bl) - dir * kBack_bl) * (row * sighting.init_len);
  return sighting;
}

Sighting sighting_of(const FishSeen& fish) {
  if (!fish.pose.ok()) return {};
  return {true, fish.init_len, fish.motion};
}

void Cast::see(const Observation& seen) {
  for (std::size_t i = 0; i < trails_.size(); ++i) trails_[i].add(sighting_of(seen.fish[i]));
  for (std::size_t i = 0; i < actors_.size(); ++i) actors_[i].see(followed(trails_[i / school_], i % school_));
}

void Cast::pose(float t, float dt_s, const Pane& pane) {
  for (Actor& actor : actors_) actor.pose(t, dt_s, pane);
}

void Cast::draw(Scene& scene) const {
  for (std::size_t i = actors_.size(); i-- > 0;) actors_[i].draw(scene);  // leaders over their followers
}

void Cast::next_character() {
  for (Actor& actor : actors_) actor.wear((actor.costume() + 1) % wardrobe_.size());
}

}  // namespace nt
