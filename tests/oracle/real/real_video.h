// SPDX-License-Identifier: Apache-2.0
// How near capture comes to the reference midlines on filmed fish, run as the app runs it (`--background auto`, the default
// working size).
//
// Clip -> counts and errors. Lengths are per cent of the fish's length, the median of the reference's over the clip.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/numbers.h"
#include "core/landmarks/fish_pose.h"
#include "tests/oracle/real/real_clips.h"

namespace nt::test {

struct RealFrame {
  int index = 0;
  ReferencePose reference;  // head first
  FishPose pose;            // pixels of the source video
  bool wrong_end = false;
  double midline = -1, head = -1, tail = -1;  // % of the length; -1 without a pose or a reference
};

struct RealAccuracy {
  std::string file, background;
  double length = 0;
  int frames = 0;  // that show the fish
  int posed = 0, wrong_end = 0, false_poses = 0;
  std::vector<RealFrame> all;

  std::vector<float> errors(double RealFrame::*which) const;  // of the frames that have one
  double share_within(double RealFrame::*which, double limit) const;
  double pose_share() const { return frames > 0 ? static_cast<double>(posed) / frames : 0; }
};

std::vector<cv::Mat> read_grey(const std::string& path);  // all frames; empty when it cannot be read

// Fins that a person sees or not, against what capture says.
struct FinAgreement {
  int seen = 0, seen_by_us = 0;       // a person sees the fin; of these we do
  int unseen = 0, unseen_by_us = 0;   // a person does not; of these we do not
  int doubtful = 0;                   // a person cannot tell: not counted
  std::vector<int> missed, invented;  // frames

  double share() const {
    return static_cast<double>(seen_by_us + unseen_by_us) / static_cast<double>(std::max(seen + unseen, 1));
  }
};

// Of one fin over a clip. `labels`: a file as sunfish_fins.txt, beside this one. Throws std::runtime_error.
FinAgreement compare_fins(const RealAccuracy& clip, const std::string& labels, bool left);

// `folder` holds the clips; without `work` at the size that the app takes.
RealAccuracy measure_real(const RealClip& clip, const std::string& folder, std::optional<Size> work = {});

}  // namespace nt::test
