// SPDX-License-Identifier: Apache-2.0
// A take swum by a character as a GLB file (glTF 2.0): mesh, texture, skin and linear keys, one for each frame.
//
// Performance + character -> file. One unit is the fish's length over GlbOptions::length. A drawing lies in the plane z = 0:
// X is the picture's x, Y the picture's y upwards, seen from +Z. A solid swims in the X-Z plane as in the BVH: Y up, X the picture's
// x, Z the picture's y. The origin is the first pixel of the source. At rest the character looks along +Y, a solid along -Z.
// Joints lie on our control points (rig_joints.h) in every key; vertices follow a skin that is fitted to our moving least
// squares (skin_fit.h) over up to kFitFrames of the frames and a set of ordinary poses, so that other motions fit as well.
// GlbReport says how far they are off over all frames. A loop ends with its first frame once more.
// Cost: the fit (about a second), then two poses a frame.
#pragma once
#include <string>

#include "app/take/performance.h"

namespace nt {

struct GlbOptions {
  double length = 1;       // of the fish, in the file's units
  float source_scale = 1;  // source pixels a working pixel
  std::string name;        // of the animation
};

struct GlbReport {
  std::size_t vertices = 0, joints = 0, keys = 0;
  std::string frame;     // units and axes in words
  std::string deformer;  // our own, against which the skin was measured: mls or lattice
  // Skinned vertices against our own, over all frames and vertices, in space, % of the body's length.
  double error_median = 0, error_p99 = 0, error_max = 0;
};

inline constexpr std::size_t kFitFrames = 96;

GlbReport write_glb(const std::string& path, const Wardrobe& wardrobe, const Performance& performance,
                    const GlbOptions& options);

}  // namespace nt
