// SPDX-License-Identifier: Apache-2.0
// Everybody on the canvas: one actor a fish, and behind each, if asked for, a school that follows it with delays.
//
// Session steps -> posed drawings. Fish i, by the number that capture gives it, wears character i of the wardrobe (round and
// round), its followers the next ones; next_character() moves everybody on by one. A follower swims what its fish swam a little earlier, shifted back and to one
// side in the body lengths and the direction of that moment, so a turn runs through the school; it is drawn a little smaller.
// Memory: what a fish did, for as long as the last follower is late. Nothing is allocated after the constructor.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/actor.h"
#include "app/observation.h"
#include "app/session.h"
#include "app/wardrobe.h"

namespace CLI {
class App;
}

namespace nt {

struct CastOptions {
  std::vector<std::string> characters;  // paths; at least one
  int school = 1;                       // drawings a fish: itself and its followers
  std::optional<MlsKind> mls;           // unset: as the character's file says
  std::optional<Deformer> deformer;     // unset: the lattice where the file has one
  bool renderer_places = false;         // of lattices: their vertices, on the GPU
};
// --mls and --deformer: of a Wardrobe. Both must outlive the parsing.
void add_deformer_options(CLI::App& command, std::optional<MlsKind>& mls, std::optional<Deformer>& deformer);
// With --max-fish, which is the capture's.
void add_cast_options(CLI::App& command, CastOptions& options, CaptureOptions& capture);

Sighting sighting_of(const FishSeen& fish);

class Cast {
 public:
  // For as many fish as the session follows at a time. Throws UserError.
  Cast(const CastOptions& options, const Session& session);
  Cast(const Cast&) = delete;
  Cast& operator=(const Cast&) = delete;

  // What the next step of the session gave.
  void see(const Observation& seen);
  // Poses all at t in (0, 1] between the last two steps; dt_s since the last call.
  void pose(float t, float dt_s, const Pane& pane);
  void draw(Scene& scene) const;

  void next_character();
  const std::string& character_name() const { return wardrobe_.path(leader().costume()); }
  const Actor& leader() const { return actors_.front(); }  // of the first fish

 private:
  // What one fish did lately, in a ring.
  class Trail {
   public:
    explicit Trail(std::size_t frames) : sightings_(frames) {}
    void add(const Sighting& sighting) {
      at_ = (at_ + 1) % sightings_.size();
      sightings_[at_] = sighting;
    }
    const Sighting& before(std::size_t frames) const {
      return sightings_[(at_ + sightings_.size() - frames) % sightings_.size()];
    }

   private:
    std::vector<Sighting> sightings_;
    std::size_t at_ = 0;
  };

  Sighting followed(const Trail& trail, std::size_t place) const;  // what the actor at this place of a school is shown

  Wardrobe wardrobe_;
  std::size_t school_;
  std::size_t delay_frames_;
  std::vector<Trail> trails_;  // one a fish
  std::vector<Actor> actors_;  // a fish's school, then the next fish's
};

}  // namespace nt
