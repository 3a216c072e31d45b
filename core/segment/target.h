// SPDX-License-Identifier: Apache-2.0
// Which blob is the fish: selection and tracking.
//
// blobs of one frame -> index of the target's blob, or a status that says why there is none.
// Selection: the user's click ([F] section 4 leaves the choice to the user), or automatic: the blob that travels and stays
// fish-shaped, or where nothing travels the largest fish-shaped one. The first choice is made in the first frame that
// offers one; during the next kAutoFrames a better one takes its place, later only a far better one.
// Tracking: gated by predicted position and area, survives `lost_after` frames without a match.
// Memory: a few hundred bytes. Cost: O(blobs).
#pragma once
#include <array>
#include <span>

#include "core/base/arena.h"
#include "core/base/pose_status.h"
#include "core/base/vec2.h"
#include "core/segment/blobs.h"

namespace nt {

struct TargetChoice {
  int blob = -1;                           // index into the blobs, -1 when there is none
  PoseStatus status = PoseStatus::absent;  // ok when the blob can give a pose
};

// 0..1: how much a blob looks like a fish from above: elongated, filled like an ellipse, not cut by the frame's edge.
float fish_likeness(const Blob& blob);

class Target {
 public:
  void set_lost_after(int frames) { lost_after_ = frames; }
  void select_at(Vec2 point) { request_ = Request::at, point_ = point; }
  void select_next() { request_ = Request::next; }
  void select_auto() { *this = Target(lost_after_); }

  TargetChoice update(std::span<const Blob> blobs);
  // What the refined outline says of the fish in this frame; its blob may have been only a part of it, or have held its
  // shadow. False when the outline suddenly encloses much more or its axis is much shorter: the fish has merged with
  // something, or closed into a ring.
  bool observe(const Box& box, Vec2 centre, float area_px, float axis_len_px);

  // True in the frame in which another fish became the target: beliefs about the last one are void.
  bool changed() const { return changed_; }
  int lost_frames() const { return lost_frames_; }
  Vec2 velocity() const { return velocity_; }  // pixels a frame, smoothed

  Target() = default;

 private:
  static constexpr int kCandidates = 16;
  static constexpr int kAutoFrames = 30;
  enum class Request { none, at, next };
  struct Candidate {
    Vec2 first, centroid;
    float travelled = 0;  // greatest distance from `first`, in lengths of the blob
    int frames = 0;
    int missed = 0;
    int blob = -1;  // in this frame
  };

  explicit Target(int lost_after) : lost_after_(lost_after) {}
  void follow_candidates(std::span<const Blob> blobs);
  float score(const Candidate& candidate, const Blob& blob) const;
  int best_candidate(std::span<const Blob> blobs) const;
  int match(std::span<const Blob> blobs) const;
  int requested(std::span<const Blob> blobs);
  int next_blob(std::span<const Blob> blobs, int present) const;
  void take(const Blob& blob);
  void move_to(Vec2 centre);
  TargetChoice accept(std::span<const Blob> blobs, int index);

  std::array<Candidate, kCandidates> candidates_{};
  int candidate_count_ = 0;
  Request request_ = Request::none;
  Vec2 point_;
  bool has_target_ = false;
  bool changed_ = false;
  bool chosen_by_user_ = false;
  int frames_since_start_ = 0;
  int lost_frames_ = 0;
  int odd_frames_ = 0;
  int lost_after_ = 30;
  Vec2 centroid_, velocity_;
  Vec2 last_centroid_, last_velocity_;  // before this frame
  int last_gap_ = 1;                    // frames between last_centroid_ and this frame
  Box box_;                             // of the whole fish, as last observed
  float area_ = 0;
  float axis_len_ = 0;
  bool whole_known_ = false;  // observed whole, not only as a blob
  float length_ = 0;          // of the fish, pixels, roughly
};

}  // namespace nt
