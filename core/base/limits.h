// SPDX-License-Identifier: Apache-2.0
// The capacities that core's memory is sized by. Everything is counted before the first frame and nothing grows.
//
// A capacity that runs out raises a flag in the step's report that names the field to raise here.
#pragma once

namespace nt {

struct Limits {
  int max_width = 960;  // pixels of the working frame
  int max_height = 544;
  int max_runs = 16384;             // horizontal runs of foreground over the whole mask, after cleaning
  int max_blobs = 1024;             // connected components
  int max_contour_points = 8192;    // of the fish's outer border
  int max_control_points = 64;      // of a character
  int max_vertices = 8192;          // of a character
  int max_triangles = 16384;        // of a character
  int max_lattice_vertices = 2000;  // of a control lattice; 0.55 KB each (core/deform/lattice.h)
};

}  // namespace nt
