// SPDX-License-Identifier: Apache-2.0
// Poses as the comma-separated table that pose tools (DeepLabCut, SLEAP) open: three header rows `scorer`, `bodyparts`,
// `coords`, then one row a frame with x, y, likelihood of each point.
//
// Points in pixels of the source video; a point that was not seen has likelihood 0 and no coordinates.
#pragma once
#include <span>
#include <string>

#include "core/landmarks/fish_pose.h"

namespace nt {

// `scale` = source width / working width. Poses have the same number of bones.
std::string pose_table(std::span<const FishPose> poses, float scale);

}  // namespace nt
