// SPDX-License-Identifier: Apache-2.0
// How near the capture comes to the tank's truth, over whole runs and with the background model's own masks.
//
// Scene, seed, size, frames -> counts and errors. Lengths are per cent of the body length, which is the truth's axis
// length in the same frame; angles are degrees. Only frames whose fish is wholly visible are scored: inside the frame, and
// under no other fish. A pose while another fish covers it is welcome where it is right and false where it is not. The
// first `warm_up` frames do not count, because the background is being learned.
// Used by bench_accuracy (long runs) and by the tests that pin the figures (short runs).
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/pipeline/pipeline.h"
#include "platform/sim/tank.h"

namespace nt::test {

struct AccuracyRun {
  TankSettings tank;
  CaptureSettings capture;
  int frames = 2000;
  int warm_up = 30;
};

struct Accuracy {
  std::string scene;
  int scored = 0;       // frames after the warm-up
  int visible = 0;      // of these, with the fish wholly inside the frame and under no other
  int posed = 0;        // of the visible ones, with a pose
  int wrong_end = 0;    // head and tail lie nearer to each other's true places than to their own
  int wrong_after = 0;  // still so after the pass over the whole run (core/motion/order)
  int false_poses = 0;  // a pose with no fish wholly visible, or more than half a body length from the fish
  int wrong_fish = 0;   // of these, at another fish
  // The longest that the fish was wholly visible without a pose of its own, frames: how long it took to be acquired again
  // after it had been away, covered, or lost with the light. Frames in which it is not visible do not count.
  int longest_wait = 0;
  int fins_open = 0;     // fins that are open in the truth of a frame with a pose ...
  int fins_found = 0;    // ... and of these, seen by us
  int fins_claimed = 0;  // fins that we say we see ...
  int fins_true = 0;     // ... and of these, open in the truth
  // One entry per pose (fins: per open fin that was seen).
  std::vector<float> head, tail, centre, midline, fin_tip;  // % of the body length
  std::vector<float> direction;                             // degrees
  // Poses and wrong ends by the confidence that was given: [0.5, 0.6), [0.6, 0.7) ... [0.9, 0.99), [0.99, 1].
  static constexpr int kBins = 6;
  int sure_poses[kBins] = {}, sure_wrong[kBins] = {};

  void add(const Accuracy& other);
  double pose_share() const { return visible > 0 ? static_cast<double>(posed) / visible : 0.0; }
  double fin_recall() const { return fins_open > 0 ? static_cast<double>(fins_found) / fins_open : 0.0; }
  double fin_precision() const { return fins_claimed > 0 ? static_cast<double>(fins_true) / fins_claimed : 0.0; }
};

// A frame worth looking at: "missed (lost)", "wrong end", "false pose".
using OddFrame = std::function<void(int64_t frame, const std::string& what)>;

// Throws std::runtime_error when the scene or the settings are refused.
Accuracy measure_accuracy(const AccuracyRun& run, const OddFrame& odd = {});

// The q-quantile (0..1) of the values; 0 when there are none.
double quantile(std::vector<float> values, double q);

// Root mean square distance, pixels, of the pose's axis (head, up_axis, centre, low_axis, tail as a polyline, sampled
// densely) from the true midline.
double midline_rms_px(const FishPose& pose, const std::vector<Vec2>& midline);

}  // namespace nt::test
