// SPDX-License-Identifier: Apache-2.0
#include "core/segment/target.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

// A finger or a mouse misses a small fish by about this much.
constexpr float kClickReach_px = 30.0f;
constexpr float kPlausible = 0.2f;    // likeness
constexpr float kAsUnlikeAs = 0.15f;  // Looks::unlike that halves the score of one that is to replace the last target

bool inside(const Box& box, Vec2 p, float margin) {
  return p.x >= static_cast<float>(box.x0) - margin && p.x < static_cast<float>(box.x1) + margin &&
         p.y >= static_cast<float>(box.y0) - margin && p.y < static_cast<float>(box.y1) + margin;
}

const Blob& blob_of(const Swimmer& s, std::span<const Blob> blobs) { return blobs[static_cast<std::size_t>(s.blob)]; }

}  // namespace

float Target::score(const Swimmer& s, const Blob& blob) const {
  const float travel = det::min(s.travelled, 1.0f);
  const float alike = id_ == 0 && looks_.area_px > 0 ? s.looks.unlike(looks_) / kAsUnlikeAs : 0.0f;
  return det::sqrt(static_cast<float>(blob.area_px)) * s.likeness * (1.0f + 4.0f * travel) / (1.0f + alike * alike);
}

// One that should be followed in place of the target, or null.
Swimmer* Target::better(Swimmers& swimmers, std::span<const Blob> blobs) const {
  const Swimmer* mine = swimmers.find(id_);
  if (mine != nullptr && (mine->blob < 0 || mine->in_heap)) return nullptr;
  Swimmer* best = nullptr;
  float best_score = 0;
  for (Swimmer& s : swimmers.all()) {
    // A piece of a fish is no better fish than the whole.
    if (s.blob < 0 || s.in_heap || (mine != nullptr && s.part_of != 0)) continue;
    const float here = score(s, blob_of(s, blobs));
    if (here > best_score) best_score = here, best = &s;
  }
  if (best == nullptr || best == mine || fish_likeness(blob_of(*best, blobs)) < kPlausible) return nullptr;
  if (mine == nullptr) return best;
  const float much_better = frames_since_start_ <= kAutoFrames ? 1.5f : 4.0f;
  return best_score > much_better * score(*mine, blob_of(*mine, blobs)) ? best : nullptr;
}

// A click waits until a blob is near it.
Swimmer* Target::clicked(Swimmers& swimmers, std::span<const Blob> blobs) const {
  int best = -1;
  float best_d = 1e9f;
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    const bool on_it = inside(blob.box, point_, 4.0f);
    const float d = length(blob.centroid - point_);
    if (blob.ghost || (!on_it && d > length_of(blob) + kClickReach_px)) continue;
    if (d - (on_it ? 1e5f : 0.0f) < best_d) best_d = d - (on_it ? 1e5f : 0.0f), best = i;
  }
  if (best < 0) return nullptr;
  Swimmer* known = swimmers.of_blob(best, point_);
  return known != nullptr ? known : swimmers.begin(blobs[static_cast<std::size_t>(best)], best);
}

// The swimmer after the target in reading order of their centres (rows, then columns), round and round; the first when
// there is no target in sight.
Swimmer* Target::next_one(Swimmers& swimmers) const {
  const auto before = [](Vec2 a, Vec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
  const Swimmer* mine = swimmers.find(id_);
  if (mine != nullptr && mine->blob < 0) mine = nullptr;
  Swimmer *first = nullptr, *next = nullptr;
  for (Swimmer& s : swimmers.all()) {
    if (&s == mine || s.blob < 0) continue;
    if (first == nullptr || before(s.centroid, first->centroid)) first = &s;
    if (mine == nullptr || !before(mine->centroid, s.centroid)) continue;
    if (next == nullptr || before(s.centroid, next->centroid)) next = &s;
  }
  return next != nullptr ? next : first;
}

Swimmer* Target::requested(Swimmers& swimmers, std::span<const Blob> blobs) {
  if (request_ == Request::none) return nullptr;
  Swimmer* found = request_ == Request::at ? clicked(swimmers, blobs) : next_one(swimmers);
  if (found != nullptr) request_ = Request::none;
  return found;
}

void Target::take(const Swimmer& s) {
  id_ = s.id;
  looks_ = {};
}

void Target::update(Swimmers& swimmers, std::span<const Blob> blobs) {
  ++frames_since_start_;
  if (id_ != 0 && swimmers.find(id_) == nullptr) {  // start anew with whatever swims in
    id_ = 0, chosen_by_user_ = false;
  }
  if (const Swimmer* wanted = requested(swimmers, blobs)) {
    chosen_by_user_ = true;
    take(*wanted);
  } else if (!chosen_by_user_) {
    if (const Swimmer* found = better(swimmers, blobs)) {
      if (id_ == 0) frames_since_start_ = 0;
      id_ = found->id;
    }
  }
  const Swimmer* mine = swimmers.find(id_);
  if (mine != nullptr && mine->blob >= 0 && !mine->in_heap && !blob_of(*mine, blobs).touches_edge && mine->frames > 30)
    looks_ = mine->looks;
}

}  // namespace nt
