// SPDX-License-Identifier: Apache-2.0
// A proposal's landmarks in pixels -> the head of a character: its frame and control points. Off the frame path.
#pragma once
#include <opencv2/core.hpp>

#include "app/author/proposal.h"
#include "core/character/character.h"

namespace nt {

// Picture -> character: origin at the centre, x to the character's right, y towards its head; the unit stays.
class CharacterFrame {
 public:
  explicit CharacterFrame(const FishPose& pose) : centre_(pose.centre), dir_(pose.dir), right_(right_of(pose.dir)) {}
  Vec2 operator()(Vec2 p) const { return direction(p - centre_); }
  Vec2 direction(Vec2 v) const { return {dot(v, right_), dot(v, dir_)}; }

 private:
  Vec2 centre_, dir_, right_;
};

// Counts, control points, confidences; the proposal must outlive it. Vertices, triangles and texture are the caller's.
Character character_of(const Proposal& proposal, const CharacterFrame& local, const LandmarkSettings& settings);

// A view onto RGBA pixels.
Picture picture_of(const cv::Mat& rgba);

}  // namespace nt
