// SPDX-License-Identifier: Apache-2.0
#include "core/segment/target.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

// A finger or a mouse misses a small fish by about this much.
constexpr float kClickReach_px = 30.0f;
// Matching: a part this large of the fish is enough within its predicted box; elsewhere a blob must lie within kNear lengths
// and have kLeastPart of the area, and its cost (lengths off, plus kAreaCost per factor e of area) must stay under kMostCost.
constexpr float kPartInBox = 0.1f, kNear = 0.6f, kLeastPart = 0.15f, kAreaCost = 0.35f, kMostCost = 1.6f;

float length_of(const Blob& blob) { return 4.0f * blob.major_px + 1.0f; }

bool inside(const Box& box, Vec2 p, float margin) {
  return p.x >= static_cast<float>(box.x0) - margin && p.x < static_cast<float>(box.x1) + margin &&
         p.y >= static_cast<float>(box.y0) - margin && p.y < static_cast<float>(box.y1) + margin;
}

}  // namespace

float fish_likeness(const Blob& blob) {
  if (blob.ghost) return 0.0f;
  const float elongation = blob.major_px / det::max(blob.minor_px, 0.3f);
  // An ellipse of the same moments has area 4 pi sigma_1 sigma_2; a ring or a branching crack has much less.
  const float ellipse = 4.0f * det::kPi * blob.major_px * det::max(blob.minor_px, 0.3f);
  const float filled = static_cast<float>(blob.area_px) / det::max(ellipse, 1.0f);
  const float long_enough = det::clamp((elongation - 1.0f) / 1.5f, 0.0f, 1.0f);
  const float compact = det::clamp((filled - 0.4f) / 0.4f, 0.0f, 1.0f);
  return (0.05f + 0.95f * long_enough * compact) * (blob.touches_edge ? 0.3f : 1.0f);
}

// Nearest-centroid matching of the blobs to what was seen before, for the selection only.
void Target::follow_candidates(std::span<const Blob> blobs) {
  for (Candidate& c : candidates_) c.blob = -1;
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    int nearest = -1;
    float best = length_of(blob);
    for (int k = 0; k < candidate_count_; ++k) {
      const Candidate& c = candidates_[static_cast<std::size_t>(k)];
      const float d = length(c.centroid - blob.centroid);
      if (c.blob < 0 && d < best) best = d, nearest = k;
    }
    if (nearest < 0 && candidate_count_ < kCandidates) {
      nearest = candidate_count_++;
      candidates_[static_cast<std::size_t>(nearest)] = {};
      candidates_[static_cast<std::size_t>(nearest)].first = blob.centroid;
    }
    if (nearest < 0) continue;
    Candidate& c = candidates_[static_cast<std::size_t>(nearest)];
    c.blob = i, c.centroid = blob.centroid, c.missed = 0, ++c.frames;
    c.travelled = det::max(c.travelled, length(c.centroid - c.first) / length_of(blob));
  }
  for (int k = 0; k < candidate_count_;) {
    Candidate& c = candidates_[static_cast<std::size_t>(k)];
    if (c.blob < 0 && ++c.missed > 5) c = candidates_[static_cast<std::size_t>(--candidate_count_)];
    else ++k;
  }
}

float Target::score(const Candidate& candidate, const Blob& blob) const {
  const float travel = det::min(candidate.travelled, 1.0f);
  return det::sqrt(static_cast<float>(blob.area_px)) * fish_likeness(blob) * (1.0f + 4.0f * travel);
}

int Target::best_candidate(std::span<const Blob> blobs) const {
  int best = -1;
  float best_score = 0;
  for (int k = 0; k < candidate_count_; ++k) {
    const Candidate& c = candidates_[static_cast<std::size_t>(k)];
    if (c.blob < 0) continue;
    const float s = score(c, blobs[static_cast<std::size_t>(c.blob)]);
    if (s > best_score) best_score = s, best = c.blob;
  }
  return best;
}

// The blob that continues the track: the largest within the fish's predicted box, else one near the predicted place and
// of about the same area.
int Target::match(std::span<const Blob> blobs) const {
  const float patience = 1.0f + 0.2f * static_cast<float>(min_int(lost_frames_, 15));
  const Vec2 moved = velocity_ * static_cast<float>(min_int(lost_frames_ + 1, 5));
  const Vec2 predicted = centroid_ + moved;
  int best = -1, largest = 0;
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    if (!blob.ghost && inside(box_, blob.centroid - moved, 0.1f * length_ * patience) && blob.area_px > largest)
      largest = blob.area_px, best = i;
  }
  if (static_cast<float>(largest) > kPartInBox * area_) return best;
  float best_cost = kMostCost;
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    const float d = length(blob.centroid - predicted) / length_;
    const float ratio = static_cast<float>(blob.area_px) / det::max(area_, 1.0f);
    if (blob.ghost || d > kNear * patience || ratio < kLeastPart) continue;
    const float cost = d / patience + kAreaCost * det::abs(det::log(ratio));
    if (cost < best_cost) best_cost = cost, best = i;
  }
  return best_cost < kMostCost ? best : -1;
}

// The blob that the user asks for; -1 when nobody asks or nothing is there yet. A click waits until a blob is near it.
int Target::requested(std::span<const Blob> blobs) {
  int best = -1;
  if (request_ == Request::at) {
    float best_d = 1e9f;
    for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
      const Blob& blob = blobs[static_cast<std::size_t>(i)];
      const bool on_it = inside(blob.box, point_, 4.0f);
      const float d = length(blob.centroid - point_);
      if (blob.ghost || (!on_it && d > length_of(blob) + kClickReach_px)) continue;
      if (d - (on_it ? 1e5f : 0.0f) < best_d) best_d = d - (on_it ? 1e5f : 0.0f), best = i;
    }
  } else if (request_ == Request::next) {
    best = next_blob(blobs, has_target_ ? match(blobs) : -1);
  }
  if (best >= 0) request_ = Request::none;
  return best;
}

// The blob after `present` in reading order of their centres (rows, then columns), round and round; the first when there
// is no present one.
int Target::next_blob(std::span<const Blob> blobs, int present) const {
  const auto centre = [&](int i) { return blobs[static_cast<std::size_t>(i)].centroid; };
  const auto before = [](Vec2 a, Vec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
  int first = -1, next = -1;
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    if (i == present || blobs[static_cast<std::size_t>(i)].ghost) continue;
    if (first < 0 || before(centre(i), centre(first))) first = i;
    if (present < 0 || !before(centre(present), centre(i))) continue;
    if (next < 0 || before(centre(i), centre(next))) next = i;
  }
  return next >= 0 ? next : first;
}

void Target::take(const Blob& blob) {
  has_target_ = changed_ = true;
  lost_frames_ = odd_frames_ = 0;
  centroid_ = blob.centroid;
  velocity_ = {};
  box_ = blob.box;
  area_ = static_cast<float>(blob.area_px);
  whole_known_ = false;
  length_ = length_of(blob);
}

TargetChoice Target::accept(std::span<const Blob> blobs, int index) {
  const Blob& blob = blobs[static_cast<std::size_t>(index)];
  last_centroid_ = centroid_, last_velocity_ = velocity_, last_gap_ = lost_frames_ + 1;
  lost_frames_ = 0;
  box_ = blob.box;
  move_to(blob.centroid);
  if (blob.touches_edge) area_ = det::max(static_cast<float>(blob.area_px), 0.7f * area_);
  return {index, blob.touches_edge ? PoseStatus::partial : PoseStatus::ok};
}

void Target::move_to(Vec2 centre) {
  const Vec2 step = (centre - last_centroid_) * (1.0f / static_cast<float>(last_gap_));
  velocity_ = lerp(last_velocity_, step, 0.4f);
  centroid_ = centre;
}

bool Target::observe(const Box& box, Vec2 centre, float area_px, float axis_len_px) {
  constexpr float kMerged = 1.6f;  // fins that open add at most a third
  constexpr float kShrunk = 0.6f;  // an axis drawn across a ring, not along the fish
  if (!whole_known_) area_ = area_px, axis_len_ = axis_len_px, whole_known_ = true;
  const bool odd = area_px > kMerged * area_ || axis_len_px < kShrunk * axis_len_;
  if (odd && ++odd_frames_ <= lost_after_) {
    centroid_ = last_centroid_ + last_velocity_ * static_cast<float>(last_gap_);  // swim on through the crossing
    velocity_ = last_velocity_;
    return false;
  }
  odd_frames_ = 0;
  box_ = box;
  move_to(centre);
  area_ += (area_px - area_) * 0.3f;
  axis_len_ += (axis_len_px - axis_len_) * 0.3f;
  length_ += (static_cast<float>(max_int(box.width(), box.height())) - length_) * 0.3f;
  return true;
}

TargetChoice Target::update(std::span<const Blob> blobs) {
  changed_ = false;
  if (!chosen_by_user_) follow_candidates(blobs);
  if (const int index = requested(blobs); index >= 0) {
    chosen_by_user_ = true;
    take(blobs[static_cast<std::size_t>(index)]);
    return accept(blobs, index);
  }
  ++frames_since_start_;
  int index = has_target_ ? match(blobs) : -1;
  if (!chosen_by_user_) {
    const int best = best_candidate(blobs);
    if (best >= 0 && best != index) {
      float mine = 0, other = 0;
      for (int k = 0; k < candidate_count_; ++k) {
        const Candidate& c = candidates_[static_cast<std::size_t>(k)];
        if (c.blob >= 0 && c.blob == index) mine = score(c, blobs[static_cast<std::size_t>(c.blob)]);
        if (c.blob == best) other = score(c, blobs[static_cast<std::size_t>(c.blob)]);
      }
      const bool plausible = fish_likeness(blobs[static_cast<std::size_t>(best)]) > 0.2f;
      const float much_better = frames_since_start_ <= kAutoFrames ? 1.5f : 4.0f;
      // A part of the fish that is tracked already is no other fish.
      const bool elsewhere = !has_target_ || !inside(box_, blobs[static_cast<std::size_t>(best)].centroid, 0);
      if (plausible && elsewhere && (!has_target_ || (index >= 0 && other > much_better * mine))) {
        if (!has_target_) frames_since_start_ = 0;
        take(blobs[static_cast<std::size_t>(best)]);
        index = best;
      }
    }
  }
  if (index >= 0) return accept(blobs, index);
  if (!has_target_) return {-1, PoseStatus::absent};
  if (++lost_frames_ > lost_after_) {  // start anew with whatever swims in
    has_target_ = false, chosen_by_user_ = false;
    candidate_count_ = 0, frames_since_start_ = 0;
  }
  return {-1, PoseStatus::lost};
}

}  // namespace nt
