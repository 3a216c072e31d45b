// SPDX-License-Identifier: Apache-2.0
// What [L] Table I reports, for any character with a lattice and any recording; for `neontetra bench --lattice` and
// `./dev bench lattice`, which adds a plain solver in Eigen to compare with.
//
// Input: a character with a lattice; a recording that moves it, or none: then its markers sway as a swimmer's do, 2 times a
// second. Output: times as medians on one thread, quality as means and worst frames. Times in microseconds unless named.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/mocap/marker_choice.h"
#include "app/mocap/marker_puppet.h"
#include "core/character/character.h"
#include "platform/linux/clock.h"

namespace nt {

struct LatticeFigures {
  std::size_t mesh_vertices = 0, mesh_triangles = 0, vertices = 0, tetrahedra = 0, joints = 0, markers = 0;
  std::size_t solver_bytes = 0;
  double order_ms = 0, factorise_us = 0, iteration_us = 0, frame_us = 0;  // a frame: 10 accelerated iterations
  double memcpy_us = 0, linear_us = 0, phong_us = 0;
  int64_t frames = 0, frames_inverted = 0;
  int worst_inverted = 0;
  double rrms = 0, worst_rrms = 0, volume = 0, worst_volume = 0, bone_sum = 0, worst_bone = 0;
  double largest_step = 0;  // of a mesh vertex between two frames, over the diagonal
};

// A recording in which the character's own markers sway: 60 frames a second, two seconds.
MarkerFile swaying_markers(const Character& character);

// The markers of every frame from choice.frame on, laid on the character.
struct LaidMarkers {
  std::vector<MarkerBinding> bindings;
  std::vector<std::vector<Vec3>> frames;
  std::vector<std::vector<uint8_t>> seen;  // of each frame's markers
};
LaidMarkers laid_markers(const Character& character, const MarkerFile& file, const MarkerChoice& choice,
                         int64_t most_frames);

// Over at most so many frames; -1 for all.
LatticeFigures lattice_figures(const Character& character, const MarkerFile& file, const MarkerChoice& choice,
                               int64_t most_frames);

double median_us(std::vector<double> samples);

template <class F>
double time_us(F f) {
  const int64_t before_ns = steady_now_ns();
  f();
  return static_cast<double>(steady_now_ns() - before_ns) * 1e-3;
}

}  // namespace nt
