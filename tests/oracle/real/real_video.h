// SPDX-License-Identifier: Apache-2.0
// How near capture comes to the reference midlines on filmed fish, run as the app runs it (`--background auto`, the default
// working size).
//
// Clip -> counts and errors. Lengths are per cent of the fish's length, the median of the reference's over the clip.
#pragma once
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

// `folder` holds the clips; without `work` at the size that the app takes.
RealAccuracy measure_real(const RealClip& clip, const std::string& folder, std::optional<Size> work = {});

}  // namespace nt::test
