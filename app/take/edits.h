// SPDX-License-Identifier: Apache-2.0
// The edits of a take as text, one a line, and what they make of a recorded motion. The recording itself is never changed.
//
// Line -> Edit and back; a list of edits on the motions of one fish -> a Clip. Edits are applied in order, each to what
// the one before has left. Frames count from 0 in the sequence as it stands then (trim and loop number anew).
// An edit is for all fish of the take, or for one: those that number frames anew are always for all.
// docs/FORMATS.md lists the lines. Errors: UserError that names the line and the nearest valid word.
// Source: [F] section 6 for `set`; the others go beyond the paper.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/motion/property.h"

namespace nt {

struct Edit {
  enum class Kind : uint8_t { set, move, smooth, exaggerate, repair, trim, loop, retime };
  Kind kind = Kind::set;
  std::string what;             // property or group, as typed
  int64_t first = 0, last = 0;  // frames, both inside; set and move: first is the frame
  double value = 0;             // angle, position, strength, factor, confidence, blended frames, speed
  int64_t radius = 0;           // move: frames to either side
  int fish = -1;                // -1: all

  bool concerns(int one) const { return fish < 0 || fish == one; }
  // Frames have other numbers after it.
  bool renumbers() const { return kind >= Kind::trim; }
};

Edit parse_edit(const std::string& line);
std::string to_line(const Edit& edit);
// Those that are for this fish.
std::vector<Edit> edits_for(std::span<const Edit> edits, int fish);
// A text file of edits: empty lines and what follows a # are passed over.
std::vector<Edit> read_edits(const std::string& path);

struct Seam {
  double angle_rad = 0;  // largest jump of an angle where the loop closes, before it was mended
  double drift_px = 0;   // how far the fish had swum
};

struct Clip {
  std::vector<Motion> motions;
  Seam seam;  // of the last `loop`
};

// `rest`: the rest pose M_0 with the same bones. Throws UserError for frames or bones that the motion does not have.
void apply_edit(const Edit& edit, const Motion& rest, Clip& clip);
Clip apply_edits(std::vector<Motion> recorded, const Motion& rest, std::span<const Edit> edits);

}  // namespace nt
