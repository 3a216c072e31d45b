// SPDX-License-Identifier: Apache-2.0
// The shape of the simulated fish: posture -> midline, outline parts, contour, and the truth of them.
//
// Input: a Posture (where the fish is, how it bends, how its fins stand), body length in pixels, kind of caudal fin.
// Output: FishShape, frame pixels; fill_pose() turns it into every attribute of [F] Table 1.
// The midline is integrated from its heading along arc length, so its length is exact: s = 0 at the snout, s = 1 at the
// tail point (the notch of a forked fin, the tip of a rounded one). All outlines live in the body's own coordinates
// (s, n): n is the distance from the midline in body lengths, positive to the fish's right, and bend with it.
// Differs from a real fish: the caudal fin, nearly edge-on from above, is drawn spread. Cost: about 20 us.
#pragma once
#include <span>
#include <vector>

#include "core/base/vec2.h"
#include "platform/sim/tank.h"

namespace nt::tank {

inline constexpr int kSpineSteps = 96;  // midline segments from snout to tail
inline constexpr int kSpineBefore = 5;  // steps that the spine reaches past the snout, straight
inline constexpr int kSpineAfter = 14;  // and past the tail point, for the lobes of the caudal fin
inline constexpr int kSpinePoints = kSpineBefore + kSpineSteps + kSpineAfter + 1;
inline constexpr int kPivotStep = 36;  // the step of the point that the Posture places: s = 0.375
inline constexpr int kLeft = 0, kRight = 1;

struct Posture {
  Vec2 pivot;                 // frame pixels, the midline at s = 0.375
  float heading_rad = 0;      // of the body at the pivot
  float bend_rad = 0;         // head direction minus tail direction: positive turns right (clockwise on the screen)
  float wave_rad = 0;         // amplitude of the travelling wave's heading at the tail
  float wave_phase_rad = 0;   // grows in time; the wave runs to the tail
  float fin_rad[2] = {0, 0};  // angle of each pectoral fin's leading edge from the body's side; see kFinFolded
};

inline constexpr float kFinFolded = -0.22f;  // the fin lies hidden along the body
inline constexpr float kFinOpen = 1.15f;     // and stands well out

struct FinShape {
  std::vector<Vec2> polygon;  // the whole fin, part of it under the body
  std::vector<Vec2> outside;  // its outline beyond the body, first and last on the body's outline; empty when hidden
  Vec2 tip;                   // outline point farthest from the midline
  Vec2 front, rear;           // where it meets the body's outline
  Vec2 root;                  // of the leading edge
  float stands_out = 0;       // largest distance beyond the body's outline, BL
};

struct FishShape {
  float length_px = 0;
  std::vector<Vec2> spine;   // kSpinePoints, evenly spaced in s
  std::vector<Vec2> normal;  // unit, to the fish's right, at each
  std::vector<Vec2> body;    // closed: body with caudal fin
  FinShape fin[2];
  std::vector<Vec2> contour;  // closed: the union of all

  std::span<const Vec2> midline() const { return std::span(spine).subspan(kSpineBefore, kSpineSteps + 1); }
  Vec2 at(float s, float n = 0.0f) const;  // body coordinates -> frame pixels
};

// Half width of the body without fins at s, BL.
float body_half_width(float s);

class FishModel {
 public:
  FishModel(float length_px, CaudalFin caudal);
  void shape(const Posture& posture, FishShape& out) const;

 private:
  void bend_spine(const Posture& posture, FishShape& out) const;
  void shape_fin(int side, float angle, FishShape& out) const;
  void join_contour(FishShape& out) const;
  float length_px_;
  std::vector<Vec2> side_;         // outline of one side, (s, n), from behind the snout to before the tail point
  std::vector<float> bend_share_;  // heading at the middle of each spine segment for a bend of 1 rad
  std::vector<float> wave_share_;  // the same for the wave's amplitude
};

// Fills the pose; the status says whether the contour lies wholly inside a frame of this size with 2 px to spare.
void fill_pose(const FishShape& shape, int width, int height, FishPose& pose);

}  // namespace nt::tank
