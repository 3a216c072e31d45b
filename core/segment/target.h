// SPDX-License-Identifier: Apache-2.0
// Which of the swimmers is the one to follow.
//
// swimmers and blobs of one frame -> the identity of the target, 0 for none.
// Selection: the user's click ([F] section 4 leaves the choice to the user), or automatic: the swimmer that travels and stays
// fish-shaped, or where nothing travels the largest fish-shaped one. The first choice is made in the first frame that
// offers one; during the next kAutoFrames a better one takes its place, later only a far better one. When the target is
// gone for good, what looks like it is preferred.
// Cost: O(swimmers).
#pragma once
#include <cstdint>
#include <span>

#include "core/segment/swimmers.h"

namespace nt {

class Target {
 public:
  void select_at(Vec2 point) { request_ = Request::at, point_ = point; }
  void select_next() { request_ = Request::next; }
  void select_auto() { *this = Target{}; }

  void update(Swimmers& swimmers, std::span<const Blob> blobs);
  uint32_t id() const { return id_; }  // of a swimmer; 0: none

 private:
  static constexpr int kAutoFrames = 30;
  enum class Request { none, at, next };

  Swimmer* requested(Swimmers& swimmers, std::span<const Blob> blobs);
  Swimmer* clicked(Swimmers& swimmers, std::span<const Blob> blobs) const;
  Swimmer* next_one(Swimmers& swimmers) const;
  Swimmer* better(Swimmers& swimmers, std::span<const Blob> blobs) const;
  float score(const Swimmer& swimmer, const Blob& blob) const;
  void take(const Swimmer& swimmer);

  Request request_ = Request::none;
  Vec2 point_;
  uint32_t id_ = 0;
  bool chosen_by_user_ = false;
  int frames_since_start_ = 0;
  Looks looks_;  // of the last target
};

}  // namespace nt
